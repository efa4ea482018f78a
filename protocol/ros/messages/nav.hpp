// Messages of nav_msgs and tf2_msgs: odometry, path and transforms of the car (REP 105 frames).
//   source the .msg files of ROS 2 Jazzy; a test compares names, types and constants with them
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/ros/message.hpp"
#include "protocol/ros/messages/geometry.hpp"
#include "protocol/ros/messages/std.hpp"

namespace pitwall::ros {

struct Odometry {
  Header header;
  std::string child_frame_id;
  PoseWithCovariance pose;
  TwistWithCovariance twist;

  static constexpr std::string_view kType = "nav_msgs/msg/Odometry";
  static constexpr auto members() {
    return std::tuple{field("header", &Odometry::header),
                      field("child_frame_id", &Odometry::child_frame_id),
                      field("pose", &Odometry::pose), field("twist", &Odometry::twist)};
  }
};

struct Path {
  Header header;
  std::vector<PoseStamped> poses;

  static constexpr std::string_view kType = "nav_msgs/msg/Path";
  static constexpr auto members() {
    return std::tuple{field("header", &Path::header), field("poses", &Path::poses)};
  }
};

struct TFMessage {
  std::vector<TransformStamped> transforms;

  static constexpr std::string_view kType = "tf2_msgs/msg/TFMessage";
  static constexpr auto members() {
    return std::tuple{field("transforms", &TFMessage::transforms)};
  }
};

}  // namespace pitwall::ros
