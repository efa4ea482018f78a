// Delay queue of CAN frames: each is released at its time.
//   in     push(frame with its time)
//   out    pop(now): the next frame that is due, or nullopt
//   order  (time, sequence of push): total
//   errors push() returns false if the queue is full; the caller counts
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hil/faults/frame_fault.hpp"

namespace pitwall::faults {

inline constexpr std::size_t kMaxDelayed = 2048;  // one second of all traffic of the car

class DelayQueue {
 public:
  DelayQueue();

  [[nodiscard]] bool push(const TimedFrame& frame);
  std::optional<TimedFrame> pop(Instant now);
  std::size_t size() const { return heap_.size(); }

 private:
  struct Entry {
    TimedFrame timed;
    std::uint64_t sequence = 0;
  };
  static bool later(const Entry& a, const Entry& b);

  std::vector<Entry> heap_;  // capacity kMaxDelayed from the start
  std::uint64_t sequence_ = 0;
};

}  // namespace pitwall::faults
