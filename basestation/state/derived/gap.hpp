// Gaps to the opponents along the track, bumper to bumper.
//   in     own station and speed, those of each opponent that is known now, length of a lap
//   out    the nearest one ahead and the nearest one behind; unset where there is none
//   invariants
//          stations are compared around the lap the short way. Whoever overlaps is both ahead and
//          behind by nothing: a gap of zero. Without the length of the lap nobody knows a gap
//   units  m, m/s; closing is positive while the car behind of the two is the faster one
//   source length of the AV-21: 192 in
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::state {

inline constexpr double kCarLength_m = 4.877;

struct Runner {
  double station_m = kUnset, speed_mps = kUnset;
};
struct Gap {
  double metres = kUnset, closing_mps = kUnset;
};
struct Gaps {
  Gap ahead, behind;
};

Gaps gaps_of(const Runner& own, std::span<const Runner> opponents, double course_m);

}  // namespace pitwall::state
