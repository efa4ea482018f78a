// Records on their way from the intake to the thread that writes them: bounded, and the intake
// never waits for the disk.
//   in     push() by the intake                 out    take_all() by the writing thread
//   law    in order; what does not fit is dropped and counted, the newest first
//   errors none besides
//   cost   push(): one copy under a lock that is held for copies and swaps only; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

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
  Instant logged{}, published{};  // on the base's clock
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
  // Waits at most so long, shorter when there is much or close() was called. False: closed, and
  // the batch is the last.
  bool take_all(Batch& batch, Duration wait);
  void close();
  std::uint64_t dropped() const;

 private:
  const std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable much_;
  std::vector<std::uint8_t> filling_;
  std::uint64_t dropped_ = 0;
  bool closed_ = false;
};

}  // namespace pitwall::recorder
