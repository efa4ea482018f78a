// Rate limit of one client's messages: so many messages at once, then so many a second. What is
// faster is not lost: it is read later, and the client's own sending stops.
//   in     that a message was heard; time
//   out    how long to read no further
//   invariants
//          in any span of t seconds no more than kAtOnce + t * kPerSecond messages are heard
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
  // Until the next may be read; none or less: now.
  Duration rest(Instant now) const { return free_at_ - now - kEach * (kAtOnce - 1); }

 private:
  Instant free_at_{};  // when all that was heard is paid for
};

}  // namespace pitwall::publishers::web
