// Does an actuator do as it was told? What it does must lie between two bounds that bracket every
// actuator of the kind: the upper jumps up with the command and comes down no faster than a lag of
// `settle`, the lower the other way round. An actuator with delay d and lag T stays between them
// but for a moment as long as settle > d + T; the moment is what `persist` is for.
//
//   command   ____/~~~~~~~~\____      upper   ____/~~~~~~~~\..     lower   ____..-~~~~~\____
//
//   in     what was told until now, what is heard
//   out    how far outside the bounds it has been for longer than `persist`; 0: it follows
//   invariants
//          an actuator that sticks, is slow, is biased or leaks by more than the tolerance leaves
//          the bounds within settle * ln(command / tolerance); nothing is judged by a feedback that
//          is old, nor for a moment after a pause of the car's own
//   units  as of the actuator
//   errors a feedback that is not a number is outside
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/signals.hpp"

namespace pitwall::safety {

struct FollowLimits {
  double settle_s = 0.2;   // above delay + lag of the actuator and its way on the bus
  double tolerance = 0.0;  // beside the bounds
  double share = 0.0;      // of the larger bound, in addition
  Duration persist = milliseconds(100);
};

struct FollowState {
  double low = kUnset, high = kUnset;
  Instant at{};      // of the last tick
  Instant within{};  // last within the bounds
};
static_assert(std::is_trivially_copyable_v<FollowState>);

inline constexpr Duration kFeedbackAgeMax = milliseconds(50);
inline constexpr Duration kFollowPause = milliseconds(25);  // two ticks missed

double straying(const FollowLimits& limits, FollowState& state, double reported,
                const world::Received<double>& received, Instant now);

}  // namespace pitwall::safety
