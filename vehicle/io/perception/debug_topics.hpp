// What the car sees, over ROS 2 topics for RViz and Foxglove beside the car; never over the radio.
//   out    in base_link, stamped with the time of the measurement in UTC: /pitwall/debug/points
//          (sensor_msgs/PointCloud2: the sweeps of all LiDARs as one cloud, our motion taken out),
//          /pitwall/debug/lidar_cars and /pitwall/debug/camera_cars
//          (visualization_msgs/MarkerArray: boxes; spheres where a camera has them)
//   law    where nobody reads a topic nothing is made for it
//   errors open(): Problem of DDS
//   cost   of the perception's threads: a copy of the cloud, where it has a reader
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "protocol/dds/domain.hpp"
#include "protocol/ros/messages/visualization.hpp"
#include "vehicle/autonomy/perception/lidar/point_cloud.hpp"
#include "vehicle/world/detection.hpp"

namespace pitwall::io {

// Of a frame; the first deletes those of the frame before.
ros::MarkerArray markers_of(const world::DetectionFrame& frame, const ros::Time& stamp);

class DebugTopics {
 public:
  static Result<std::unique_ptr<DebugTopics>, Problem> open(const dds::DomainConfig& config);

  // Each kind of sensor by one thread.
  void show(const perception::PointCloud& cloud, const world::DetectionFrame& frame);
  void show(const world::DetectionFrame& frame);

 private:
  DebugTopics() = default;

  std::unique_ptr<dds::Domain> domain_;
  dds::Writer *points_ = nullptr, *lidar_cars_ = nullptr, *camera_cars_ = nullptr;
};

}  // namespace pitwall::io
