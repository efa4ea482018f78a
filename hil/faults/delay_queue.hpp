// Frames that wait for their instant.
//   in     push(frame with its instant); out   pop(now): the next one that is due, or nothing
//   order  (instant, sequence of push): total
//   errors full -> push() is false; the caller counts
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hil/faults/frame_fault.hpp"

namespace pitwall::faults {

inline constexpr std::size_t kMaxDelayed = 2048;  // one second of the car's whole traffic

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
