// Shared memory between the car process and its guardian: one file that both map. Each side writes
// its own value and reads the other's; neither waits for the other.
//   in     a name: a file in /dev/shm; a path if it contains a slash
//   out    the newest value that is whole, or nothing
//   invariants
//          two copies per value, written in turn, each with a sequence number and a CRC-32: a
//          writer that is killed in the middle of one copy leaves the other one intact. The newest
//          whole copy counts. Values outlive their writers until they are written again
//   errors open(): Problem with the path: no permission, or a file of another layout; afterwards
//          none. A copy that is not whole is not read
//   cost   no allocation, no system call after open(); a CarRecord below 15 us, a Status below 1 us
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/guardian/record.hpp"

namespace pitwall::io {

// Path of the file for a name.
std::string shared_stop_path(std::string_view name);

class SharedStop {
 public:
  static Result<SharedStop, Problem> open(std::string_view name);
  SharedStop(SharedStop&& other) noexcept;
  SharedStop& operator=(SharedStop&& other) = delete;
  ~SharedStop();

  void write(const guardian::CarRecord& record);
  void write(const guardian::Status& status);
  // Returns false, and leaves the value unchanged, if there is no whole copy yet.
  bool read(guardian::CarRecord& record) const;
  bool read(guardian::Status& status) const;

 private:
  struct Layout;
  explicit SharedStop(Layout* layout) : layout_(layout) {}
  Layout* layout_ = nullptr;
};

}  // namespace pitwall::io
