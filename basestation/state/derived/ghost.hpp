// Estimated position of a car while nothing is received.
//   in     its last known position and speed, the track
//   out    a pose further along the track, and the radius in which the car is; nullopt before
//          kGhostAfter, after kGhostFor, and if no position was ever known
//   invariants
//          the radius begins at the position's sigma and grows with the unknown acceleration since
//          then, up to kUnknownAccel_mps2 either way
//          without a track the car is assumed to go straight on
//   frames Map
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "basestation/state/course.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::state {

inline constexpr Duration kGhostAfter = milliseconds(500), kGhostFor = seconds(10);
inline constexpr double kUnknownAccel_mps2 = 5.0;  // that of a controlled stop

struct LastPlace {
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset, speed_mps = kUnset, sigma_m = kUnset;
  double station_m = kUnset, offset_m = kUnset;
};
struct Ghost {
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset, radius_m = kUnset;
};
// `age`: time since the car was at that position.
std::optional<Ghost> ghost_of(const LastPlace& last, Duration age, const Course* course);

}  // namespace pitwall::state
