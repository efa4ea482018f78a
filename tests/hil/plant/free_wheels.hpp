// Wheel speeds of a car whose speed is imposed.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "hil/plant/plant.hpp"

namespace pitwall::plant {

// Sets each wheel to the speed of its hub, so that no wheel drives or brakes. With all wheels at
// the speed of the car they would resist every turn, like locked axles.
inline void roll_freely(const Params& p, State& s) {
  const Motion& m = s.motion;
  const double angle_rad = m.steering_motor_rad / p.steering.ratio;
  for (std::size_t w = 0; w < world::kCorners; ++w) {
    const bool front = w < 2;
    const double half_m = 0.5 * (front ? p.chassis.track_front_m : p.chassis.track_rear_m);
    const double ahead_mps = m.vx_mps - m.yaw_rate_rad_per_s * (w % 2 == 0 ? half_m : -half_m);
    const double left_mps = m.vy_mps + m.yaw_rate_rad_per_s * p.chassis.front_axle_m;
    const double along_mps =
        front ? ahead_mps * std::cos(angle_rad) + left_mps * std::sin(angle_rad) : ahead_mps;
    s.motion.wheel_rad_per_s[w] = along_mps / (front ? p.front.radius_m : p.rear.radius_m);
    s.locked[w] = m.vx_mps == 0.0;
  }
}

}  // namespace pitwall::plant
