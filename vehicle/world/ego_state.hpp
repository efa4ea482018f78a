// Ego state: position, attitude and motion of the car, the output of localization.
//   frames Map: local tangent plane at the track's datum, x east, y north, yaw from east,
//          counter-clockwise. Body: ISO 8855, origin at the centre of gravity.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::world {

enum class Validity : std::uint8_t { kNever, kGood, kDeadReckoning, kLost };

struct EgoState {
  Instant at{};
  Validity validity = Validity::kNever;
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset;
  double vx_mps = kUnset, vy_mps = kUnset;       // body, in the plane of the road
  double yaw_rate_rad_per_s = kUnset;            // about body z
  double ax_mps2 = kUnset, ay_mps2 = kUnset;     // specific force, body
  double z_m = kUnset;                           // Map; unset by a planar filter
  double roll_rad = kUnset, pitch_rad = kUnset;  // ISO 8855: on a positive banking (left side
                                                 // lower) the roll is minus the banking
  double position_sigma_m = kUnset;              // larger semi-axis, one sigma
  double yaw_sigma_rad = kUnset;
};

}  // namespace pitwall::world
