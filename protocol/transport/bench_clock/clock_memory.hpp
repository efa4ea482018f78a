// Memory-mapped file with the clock page of bench time.
//   in     path of a file in memory (/dev/shm) that all its readers may write; created if missing
//   out    the page, for the life of this object; whether a bench keeps it
//   invariants
//          a bench holds a lock on the file, which the kernel releases when the process ends
//   errors Problem with the path: no such folder, no permission, a file of another kind
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "protocol/transport/bench_clock/clock_page.hpp"
#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::transport {

class ClockMemory {
 public:
  static Result<ClockMemory, Problem> open(const std::string& path);
  ClockMemory(ClockMemory&& other) noexcept
      : file_(std::move(other.file_)), page_(std::exchange(other.page_, nullptr)) {}
  ClockMemory& operator=(ClockMemory&&) = delete;
  ~ClockMemory();

  bool is_open() const { return page_ != nullptr; }
  ClockPage& page() const { return *page_; }
  // False: another process keeps it.
  bool lock();
  void unlock();
  bool is_locked() const;  // by another process
  // Lets time run on from its present value after a bench was killed.
  void resume(Instant wall);

 private:
  ClockMemory(FileDescriptor file, ClockPage* page) : file_(std::move(file)), page_(page) {}

  FileDescriptor file_;
  ClockPage* page_ = nullptr;
};

}  // namespace pitwall::transport
