// True pose and motion of a car in the bench, of ours as well as of the others.
//   frames Map, as EgoState: yaw from east, counter-clockwise; velocities in Body (x forward, y
//          left); station and offset as TrackMap has them. The position is the centre of the
//          rectangle around the car, as in plant::road_at()
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/vocabulary/units.hpp"

namespace pitwall::plant {

struct CarPose {
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset;
  double vx_mps = kUnset, vy_mps = kUnset, yaw_rate_rad_per_s = kUnset;
  double s_m = kUnset, n_m = kUnset;
  double length_m = kUnset, width_m = kUnset;
};

}  // namespace pitwall::plant
