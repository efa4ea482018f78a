// What a LiDAR of our car at rest sees of one other car on the straight of the oval.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/transport/clock.hpp"
#include "tests/vehicle/autonomy/perception/lidar/ego_on_oval.hpp"
#include "tests/vehicle/autonomy/perception/lidar/lidar_scene.hpp"

namespace pitwall::io {

inline constexpr double kSensor_m = 0.7;  // over Body, which is 0.3 m over the road

inline perception::PointCloud car_cloud(double x_m, double y_m) {
  return perception::sweep_of(
      {.sensor_m = kSensor_m + 0.3, .boxes = {{.x_m = x_m, .y_m = y_m, .yaw_rad = 0.0}}}, 1);
}

inline world::EgoState ego_at_rest() {
  return perception::ego_on_oval(150.0, 0.0, transport::monotonic_now());
}

}  // namespace pitwall::io
