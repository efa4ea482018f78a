// Estimated position of a car while nothing is received.
//   in     its last known place and speed, the track
//   out    a pose further along the track, and the radius in which the car is; none while its place
//          is known, after kGhostFor, and where there never was a place
//   invariants
//          the radius begins at the position's sigma and grows with what the car may have done
//          meanwhile: an acceleration of kUnknownAccel either way
//          without a track it goes straight on
//   frames Map
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "basestation/state/course.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::state {

inline constexpr Duration kGhostAfter = milliseconds(500), kGhostFor = seconds(10);
inline constexpr double kUnknownAccel_mps2 = 5.0;  // a controlled stop

struct LastPlace {
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset, speed_mps = kUnset, sigma_m = kUnset;
  double station_m = kUnset, offset_m = kUnset;
};
struct Ghost {
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset, radius_m = kUnset;
};
// `age` of the place: since the car was there.
std::optional<Ghost> ghost_of(const LastPlace& last, Duration age, const Course* course);

}  // namespace pitwall::state
