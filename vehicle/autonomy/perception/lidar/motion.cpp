// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/motion.hpp"

namespace pitwall::perception {

void append_in_body(const LidarSweep& sweep, const BodyMotion& motion, PointCloud& cloud) {
  const SensorAxes axes = axes_of(sweep.mount);
  cloud.reserve(cloud.size() + sweep.points.size());
  for (const LidarPoint& p : sweep.points) {
    const auto [x_m, y_m, z_m] = in_body(sweep.mount, axes, {p.x_m, p.y_m, p.z_m});
    const double since_s = sweep.begun_s + p.after_s;
    const double yaw_rad = since_s * motion.yaw_rate_rad_per_s;
    const double cos_yaw = 1.0 - 0.5 * yaw_rad * yaw_rad;
    // On an arc the chord points half the turn to the side.
    const double ahead_m = since_s * (motion.vx_mps - 0.5 * yaw_rad * motion.vy_mps);
    const double left_m = since_s * (motion.vy_mps + 0.5 * yaw_rad * motion.vx_mps);
    LidarPoint moved = p;
    moved.x_m = static_cast<float>(cos_yaw * x_m - yaw_rad * y_m + ahead_m);
    moved.y_m = static_cast<float>(yaw_rad * x_m + cos_yaw * y_m + left_m);
    moved.z_m = static_cast<float>(z_m);
    moved.after_s = static_cast<float>(since_s);
    cloud.push_back(moved);
  }
}

}  // namespace pitwall::perception
