// Bounded queue of records from a loop to the thread that writes them. The loop never waits,
// neither for the disk nor for the other thread.
//   in     push() by one thread                 out    take_all() by one other
//   invariants
//          records keep their order; a new record that does not fit is dropped and counted
//          push() is wait-free: copies and two atomic accesses, no lock, no system call, no
//          allocation; all memory is touched at construction
//   errors none
//   cost   push(): one copy                     take_all(): one copy of all, and a sleep
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::recorder {

struct Record {
  std::uint16_t channel = 0;
  Instant logged{}, published{};  // on the clock of the recording process
  std::span<const std::uint8_t> data;
};

// Reads the records of a batch one after the other.
class Batch {
 public:
  std::optional<Record> next();

 private:
  friend class RecordQueue;
  std::vector<std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

class RecordQueue {
 public:
  explicit RecordQueue(std::size_t bytes);

  bool push(const Record& record);
  // Returns after `wait`, or earlier after close(). False: closed, and this batch is the last.
  bool take_all(Batch& batch, Duration wait);
  void close();  // by the thread that pushes
  std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

 private:
  static constexpr std::size_t kCacheLine = 64;

  void copy_in(std::uint64_t at, const void* from, std::size_t bytes);
  void copy_out(std::uint64_t at, std::span<std::uint8_t> to) const;

  std::vector<std::uint8_t> ring_;
  // Bytes pushed and taken since the start; each counter is written by one thread only.
  alignas(kCacheLine) std::atomic<std::uint64_t> pushed_ = 0;
  alignas(kCacheLine) std::atomic<std::uint64_t> taken_ = 0;
  alignas(kCacheLine) std::atomic<std::uint64_t> dropped_ = 0;
  std::mutex mutex_;  // protects closed_, on which take_all() waits
  std::condition_variable ends_;
  bool closed_ = false;
  bool refuses_ = false;  // copy of closed_ for the pushing thread
};

}  // namespace pitwall::recorder
