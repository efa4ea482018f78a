// Command-following monitor of one actuator. The feedback must lie between two bounds that enclose
// every actuator of the kind: the upper bound follows a rising command at once and a falling one
// with the lag `settle`; the lower bound does the opposite. An actuator with delay d and lag T
// stays within them if settle > d + T, except for a short moment, which `persist` covers.
//
//   command   ____/~~~~~~~~\____      upper   ____/~~~~~~~~\..     lower   ____..-~~~~~\____
//
//   in     the last command, the feedback
//   out    excess over the bounds once it has lasted for `persist`; 0 while the actuator follows
//   invariants
//          an actuator that sticks, is slow, is biased or leaks by more than the tolerance leaves
//          the bounds within settle * ln(command / tolerance)
//          nothing is reported on stale feedback, or for `persist` after a pause of the car's own
//          process
//   units  those of the actuator
//   errors feedback that is not a number counts as outside
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/signals.hpp"

namespace pitwall::safety {

struct FollowLimits {
  double settle_s = 0.2;   // above delay + lag of the actuator and the bus
  double tolerance = 0.0;  // outside the bounds
  double share = 0.0;      // of the larger bound, added to the tolerance
  Duration persist = milliseconds(100);
};

struct FollowState {
  double low = kUnset, high = kUnset;
  Instant at{};      // last tick
  Instant within{};  // last time within the bounds
};
static_assert(std::is_trivially_copyable_v<FollowState>);

inline constexpr Duration kFeedbackAgeMax = milliseconds(50);
inline constexpr Duration kFollowPause = milliseconds(25);  // two ticks missed

double excess_deviation(const FollowLimits& limits, FollowState& state, double reported,
                        const world::Received<double>& received, Instant now);

}  // namespace pitwall::safety
