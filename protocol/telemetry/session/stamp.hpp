// Stamps of key exchange openings: each opening of a car has a greater stamp than all before, so
// that a base that stores the greatest one detects a replay at the cost of one hash.
//   in     StampClock: the monotonic clock and its offset to UTC
//          StaleStamps: stamps that were refused
//   out    next(): strictly increasing, also if the calendar clock was set back, or a base reported
//          a greater stamp; is_new(): whether a refused stamp was never seen before
//   units  nanoseconds since 1970-01-01 UTC by the car's clock
//   cost   constant; no allocation
//   source WireGuard, a whitepaper, 5.1 (timestamp of the first message)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "protocol/vocabulary/random.hpp"

#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

using Stamp = std::uint64_t;

class StampClock {
 public:
  // `to_utc`: offset from the monotonic clock to nanoseconds since 1970.
  explicit constexpr StampClock(Duration to_utc) : to_utc_(to_utc) {}

  constexpr Stamp next(Instant now) {
    const std::int64_t utc_ns = std::max<std::int64_t>(0, (now + to_utc_).ns);
    last_ = std::max(static_cast<Stamp>(utc_ns), last_ + 1);
    return last_;
  }
  // The next stamps are greater than `reported`.
  constexpr void exceed(Stamp reported) { last_ = std::max(last_, reported); }

 private:
  Duration to_utc_;
  Stamp last_ = 0;
};

// Cache of the last few thousand refused stamps. A recorded opening repeats its stamp; a car whose
// clock was set back sends a stamp that was never seen, and only such an opening gets a reply.
class StaleStamps {
 public:
  constexpr bool is_new(Stamp stamp) {
    // Recorded stamps have equal spacing, so the hash has to use every bit.
    Set& set = sets_[mix_bits(stamp) % sets_.size()];
    if (std::find(set.stamps.begin(), set.stamps.end(), stamp) != set.stamps.end()) return false;
    set.stamps[set.next] = stamp;
    set.next = static_cast<std::uint8_t>((set.next + 1) % kWays);
    return true;
  }

 private:
  static constexpr std::size_t kWays = 8, kSets = 1'024;
  struct Set {
    std::array<Stamp, kWays> stamps{};
    std::uint8_t next = 0;
  };

  std::array<Set, kSets> sets_{};
};

}  // namespace pitwall::telemetry
