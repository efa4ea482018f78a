// Points as a LiDAR's driver publishes them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>

#include "protocol/ros/messages/sensor.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/perception/lidar/point_cloud.hpp"

namespace pitwall::io {

inline ros::PointCloud2 cloud_message(const perception::PointCloud& points, UtcTime stamp) {
  ros::PointCloud2 message;
  message.header.stamp = ros::time_of(stamp);
  message.header.frame_id = "lidar";
  message.fields = {
      {"x", 0, 7, 1}, {"y", 4, 7, 1}, {"z", 8, 7, 1}, {"intensity", 12, 7, 1}, {"time", 16, 7, 1}};
  message.height = 1, message.width = static_cast<std::uint32_t>(points.size());
  message.point_step = 20, message.row_step = 20 * message.width;
  message.data.resize(message.row_step);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const perception::LidarPoint& p = points[i];
    const float numbers[] = {p.x_m, p.y_m, p.z_m, p.intensity, p.after_s};
    std::memcpy(message.data.data() + 20 * i, numbers, sizeof numbers);
  }
  message.is_dense = true;
  return message;
}

}  // namespace pitwall::io
