// Rate limit of one client's messages: a burst, then a constant rate. Faster messages are not lost:
// they are read later, and TCP flow control slows the client.
//   in     each message read; time
//   out    how long to pause reading
//   invariants
//          in any span of t seconds at most kAtOnce + t * kPerSecond messages are read
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::publishers::web {

class Pace {
 public:
  static constexpr std::int64_t kAtOnce = 60, kPerSecond = 20;
  static constexpr Duration kEach = seconds(1) / kPerSecond;

  void receive(Instant now) { free_at_ = std::max(free_at_, now) + kEach; }
  // Time until the next message may be read; zero or negative: now.
  Duration rest(Instant now) const { return free_at_ - now - kEach * (kAtOnce - 1); }

 private:
  Instant free_at_{};  // time until which the messages read so far use up the rate
};

}  // namespace pitwall::publishers::web
