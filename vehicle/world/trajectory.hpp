// Path with a planned speed at every point: output of planning, input of control.
//   units  in the names: m, rad, m/s, m/s^2, s
//   frames Map; yaw and curvature positive to the left; banking positive where the left side is
//          lower (towards the inside of a left-hand oval)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::world {

struct TrajectoryPoint {
  double s_m = kUnset;  // along the trajectory, from its first point
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset;
  double curvature_per_m = kUnset;
  double bank_rad = kUnset;
  double speed_mps = kUnset;
  double accel_mps2 = kUnset;  // planned, along the path
  double time_s = kUnset;      // from the first point; infinite where the car never arrives
  double room_left_m = kUnset, room_right_m = kUnset;  // from the path to the walls
};

inline constexpr std::size_t kTrajectoryPoints = 128;

struct Trajectory {
  Instant at{};  // time of planning
  FixedVector<TrajectoryPoint, kTrajectoryPoints> points;
};

}  // namespace pitwall::world
