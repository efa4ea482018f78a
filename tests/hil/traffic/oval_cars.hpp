// Cars on the oval, straight along it: the true state of ours, and another one's rectangle.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "hil/plant/car_pose.hpp"
#include "hil/plant/plant.hpp"
#include "tests/hil/traffic/oval.hpp"

namespace pitwall::traffic {

inline constexpr double kOrigin_m = 0.28;  // of Body over the road

inline plant::CarPose pose_on_oval(double s_m, double n_m, double speed_mps) {
  const world::TrackPoint at = oval().offset(s_m, n_m);
  return {.x_m = at.x_m,
          .y_m = at.y_m,
          .yaw_rad = at.yaw_rad,
          .vx_mps = speed_mps,
          .vy_mps = 0.0,
          .yaw_rate_rad_per_s = 0.0,
          .s_m = s_m,
          .n_m = n_m,
          .length_m = 4.92,
          .width_m = 1.89};
}

inline plant::Truth truth_on_oval(double s_m, double speed_mps) {
  const world::TrackPoint at = oval().offset(s_m, 0.0);
  plant::Truth truth;
  truth.x_m = at.x_m, truth.y_m = at.y_m, truth.yaw_rad = at.yaw_rad, truth.z_m = kOrigin_m;
  truth.roll_rad = -at.bank_rad, truth.pitch_rad = 0.0, truth.heading_rate_rad_per_s = 0.0;
  truth.map_vx_mps = speed_mps * std::cos(at.yaw_rad);
  truth.map_vy_mps = speed_mps * std::sin(at.yaw_rad), truth.map_vz_mps = 0.0;
  return truth;
}

}  // namespace pitwall::traffic
