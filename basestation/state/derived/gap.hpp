// Gaps to the opponents along the track, bumper to bumper.
//   in     station and speed of the own car and of each opponent that is known now, length of a lap
//   out    the gap to the nearest one ahead and to the nearest one behind; unset if there is none
//   invariants
//          the difference of two stations is taken the short way around the lap. A car that
//          overlaps is both ahead and behind with a gap of zero. Without the length of the lap all
//          gaps are unset
//   units  m, m/s; closing is positive while the car behind is the faster of the two
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
