// Messages of geometry_msgs: metres, radians, seconds; right-handed, x forward, y left, z up
// (REP 103). Covariances are stored row by row.
//   source the .msg files of ROS 2 Jazzy; a test compares names, types and constants with them
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/ros/message.hpp"
#include "protocol/ros/messages/std.hpp"

namespace pitwall::ros {

struct Point {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  static constexpr std::string_view kType = "geometry_msgs/msg/Point";
  static constexpr auto members() {
    return std::tuple{field("x", &Point::x), field("y", &Point::y), field("z", &Point::z)};
  }
};

struct Vector3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  static constexpr std::string_view kType = "geometry_msgs/msg/Vector3";
  static constexpr auto members() {
    return std::tuple{field("x", &Vector3::x), field("y", &Vector3::y), field("z", &Vector3::z)};
  }
};

struct Quaternion {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  double w = 1.0;

  static constexpr std::string_view kType = "geometry_msgs/msg/Quaternion";
  static constexpr auto members() {
    return std::tuple{field("x", &Quaternion::x), field("y", &Quaternion::y),
                      field("z", &Quaternion::z), field("w", &Quaternion::w)};
  }
};

struct Pose {
  Point position;
  Quaternion orientation;

  static constexpr std::string_view kType = "geometry_msgs/msg/Pose";
  static constexpr auto members() {
    return std::tuple{field("position", &Pose::position), field("orientation", &Pose::orientation)};
  }
};

struct PoseStamped {
  Header header;
  Pose pose;

  static constexpr std::string_view kType = "geometry_msgs/msg/PoseStamped";
  static constexpr auto members() {
    return std::tuple{field("header", &PoseStamped::header), field("pose", &PoseStamped::pose)};
  }
};

struct PoseWithCovariance {
  Pose pose;
  std::array<double, 36> covariance{};

  static constexpr std::string_view kType = "geometry_msgs/msg/PoseWithCovariance";
  static constexpr auto members() {
    return std::tuple{field("pose", &PoseWithCovariance::pose),
                      field("covariance", &PoseWithCovariance::covariance)};
  }
};

struct Twist {
  Vector3 linear;
  Vector3 angular;

  static constexpr std::string_view kType = "geometry_msgs/msg/Twist";
  static constexpr auto members() {
    return std::tuple{field("linear", &Twist::linear), field("angular", &Twist::angular)};
  }
};

struct TwistWithCovariance {
  Twist twist;
  std::array<double, 36> covariance{};

  static constexpr std::string_view kType = "geometry_msgs/msg/TwistWithCovariance";
  static constexpr auto members() {
    return std::tuple{field("twist", &TwistWithCovariance::twist),
                      field("covariance", &TwistWithCovariance::covariance)};
  }
};

struct Transform {
  Vector3 translation;
  Quaternion rotation;

  static constexpr std::string_view kType = "geometry_msgs/msg/Transform";
  static constexpr auto members() {
    return std::tuple{field("translation", &Transform::translation),
                      field("rotation", &Transform::rotation)};
  }
};

struct TransformStamped {
  Header header;
  std::string child_frame_id;
  Transform transform;

  static constexpr std::string_view kType = "geometry_msgs/msg/TransformStamped";
  static constexpr auto members() {
    return std::tuple{field("header", &TransformStamped::header),
                      field("child_frame_id", &TransformStamped::child_frame_id),
                      field("transform", &TransformStamped::transform)};
  }
};

}  // namespace pitwall::ros
