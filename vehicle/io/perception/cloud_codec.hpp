// Points of a LiDAR's message.
//   in     sensor_msgs/PointCloud2 whose sizes fit (contradiction_of)
//   out    its points in the frame of the sensor. x, y, z are needed; intensity (or reflectance,
//          reflectivity) and the time of the ray are taken where they are: t or offset_time (in ns
//          since the stamp), time (in s since the stamp), timestamp (in s, UTC)
//   errors nullptr: none; else why the cloud cannot be read, and no points. A point that is not
//          finite stays in the cloud
//   cost   O(points); allocates only while the cloud grows
//   source fields of the drivers of Ouster, Livox, Velodyne, Hesai and Luminar
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "protocol/ros/messages/sensor.hpp"
#include "vehicle/autonomy/perception/lidar/point_cloud.hpp"

namespace pitwall::io {

inline constexpr std::size_t kPointsMost = 400'000;  // of one sweep

// As a driver publishes them, but for the header: x, y, z, intensity and time (in s).
ros::PointCloud2 message_of(std::span<const perception::LidarPoint> points);

const char* read_points(const ros::PointCloud2& message, perception::PointCloud& points);

}  // namespace pitwall::io
