// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/motion.hpp"

#include <Eigen/Geometry>

namespace pitwall::perception {

void append_in_body(const LidarSweep& sweep, const BodyMotion& motion, PointCloud& cloud) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  const Eigen::Matrix3d turn = (AngleAxisd(sweep.mount.yaw_rad, Vector3d::UnitZ()) *
                                AngleAxisd(sweep.mount.pitch_rad, Vector3d::UnitY()) *
                                AngleAxisd(sweep.mount.roll_rad, Vector3d::UnitX()))
                                   .toRotationMatrix();
  const Vector3d at{sweep.mount.x_m, sweep.mount.y_m, sweep.mount.z_m};
  cloud.reserve(cloud.size() + sweep.points.size());
  for (const LidarPoint& p : sweep.points) {
    const Vector3d body = turn * Vector3d{p.x_m, p.y_m, p.z_m} + at;
    const double since_s = sweep.begun_s + p.after_s;
    const double yaw_rad = since_s * motion.yaw_rate_rad_per_s;
    const double cos_yaw = 1.0 - 0.5 * yaw_rad * yaw_rad;
    // On an arc the chord points half the turn to the side.
    const double ahead_m = since_s * (motion.vx_mps - 0.5 * yaw_rad * motion.vy_mps);
    const double left_m = since_s * (motion.vy_mps + 0.5 * yaw_rad * motion.vx_mps);
    LidarPoint moved = p;
    moved.x_m = static_cast<float>(cos_yaw * body.x() - yaw_rad * body.y() + ahead_m);
    moved.y_m = static_cast<float>(yaw_rad * body.x() + cos_yaw * body.y() + left_m);
    moved.z_m = static_cast<float>(body.z());
    moved.after_s = static_cast<float>(since_s);
    cloud.push_back(moved);
  }
}

}  // namespace pitwall::perception
