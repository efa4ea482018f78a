// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/mount/sensor_pose.hpp"

#include <cmath>

namespace pitwall::perception {

SensorAxes axes_of(const SensorPose& pose) {
  const double cr = std::cos(pose.roll_rad), sr = std::sin(pose.roll_rad);
  const double cp = std::cos(pose.pitch_rad), sp = std::sin(pose.pitch_rad);
  const double cy = std::cos(pose.yaw_rad), sy = std::sin(pose.yaw_rad);
  return {{{cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr},
           {sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr},
           {-sp, cp * sr, cp * cr}}};
}

std::array<double, 3> in_body(const SensorPose& pose, const SensorAxes& axes,
                              const std::array<double, 3>& at) {
  std::array<double, 3> out{pose.x_m, pose.y_m, pose.z_m};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) out[i] += axes[i][k] * at[k];
  return out;
}

}  // namespace pitwall::perception
