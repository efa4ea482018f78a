// Stamps of key exchange openings: each opening of a car has a greater one than all before, so that
// a base which remembers the greatest recognises a replay before it computes anything but a hash.
//   in     StampClock: the monotonic clock and its distance to UTC
//          StaleStamps: stamps that were refused
//   out    next(): strictly increasing, also when the calendar clock was set back or a base told a
//          greater stamp; is_new(): whether a refused stamp was never seen before
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
  // `to_utc`: what the monotonic clock lacks to nanoseconds since 1970.
  explicit constexpr StampClock(Duration to_utc) : to_utc_(to_utc) {}

  constexpr Stamp next(Instant now) {
    const std::int64_t utc_ns = std::max<std::int64_t>(0, (now + to_utc_).ns);
    last_ = std::max(static_cast<Stamp>(utc_ns), last_ + 1);
    return last_;
  }
  // From now on greater than this.
  constexpr void exceed(Stamp reported) { last_ = std::max(last_, reported); }

 private:
  Duration to_utc_;
  Stamp last_ = 0;
};

// The last few thousand refused stamps. A recorded opening repeats its stamp; a car whose clock
// went back sends a stamp that nobody has seen, and is the only one worth a reply.
class StaleStamps {
 public:
  constexpr bool is_new(Stamp stamp) {
    // Recorded stamps lie at equal distances: every bit has to count.
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
