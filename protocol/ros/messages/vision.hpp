// Messages of vision_msgs: detections of a camera in pixels, of a LiDAR as boxes in metres. In an
// image x is to the right and y down.
//   source ros-perception/vision_msgs 4, of ROS 2 Humble to Kilted (the 2 of Foxy has other
//          fields); a test compares the type hashes with those that rosidl makes
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/ros/message.hpp"
#include "protocol/ros/messages/geometry.hpp"
#include "protocol/ros/messages/std.hpp"

namespace pitwall::ros {

struct ObjectHypothesis {
  std::string class_id;
  double score = 0.0;

  static constexpr std::string_view kType = "vision_msgs/msg/ObjectHypothesis";
  static constexpr auto members() {
    return std::tuple{field("class_id", &ObjectHypothesis::class_id),
                      field("score", &ObjectHypothesis::score)};
  }
};

struct ObjectHypothesisWithPose {
  ObjectHypothesis hypothesis;
  PoseWithCovariance pose;

  static constexpr std::string_view kType = "vision_msgs/msg/ObjectHypothesisWithPose";
  static constexpr auto members() {
    return std::tuple{field("hypothesis", &ObjectHypothesisWithPose::hypothesis),
                      field("pose", &ObjectHypothesisWithPose::pose)};
  }
};

struct BoundingBox3D {
  Pose center;
  Vector3 size;

  static constexpr std::string_view kType = "vision_msgs/msg/BoundingBox3D";
  static constexpr auto members() {
    return std::tuple{field("center", &BoundingBox3D::center), field("size", &BoundingBox3D::size)};
  }
};

struct Detection3D {
  Header header;
  std::vector<ObjectHypothesisWithPose> results;
  BoundingBox3D bbox;
  std::string id;

  static constexpr std::string_view kType = "vision_msgs/msg/Detection3D";
  static constexpr auto members() {
    return std::tuple{field("header", &Detection3D::header),
                      field("results", &Detection3D::results), field("bbox", &Detection3D::bbox),
                      field("id", &Detection3D::id)};
  }
};

struct Detection3DArray {
  Header header;
  std::vector<Detection3D> detections;

  static constexpr std::string_view kType = "vision_msgs/msg/Detection3DArray";
  static constexpr auto members() {
    return std::tuple{field("header", &Detection3DArray::header),
                      field("detections", &Detection3DArray::detections)};
  }
};

struct Point2D {
  double x = 0.0;
  double y = 0.0;

  static constexpr std::string_view kType = "vision_msgs/msg/Point2D";
  static constexpr auto members() {
    return std::tuple{field("x", &Point2D::x), field("y", &Point2D::y)};
  }
};

struct Pose2D {
  Point2D position;
  double theta = 0.0;

  static constexpr std::string_view kType = "vision_msgs/msg/Pose2D";
  static constexpr auto members() {
    return std::tuple{field("position", &Pose2D::position), field("theta", &Pose2D::theta)};
  }
};

struct BoundingBox2D {
  Pose2D center;
  double size_x = 0.0;
  double size_y = 0.0;

  static constexpr std::string_view kType = "vision_msgs/msg/BoundingBox2D";
  static constexpr auto members() {
    return std::tuple{field("center", &BoundingBox2D::center),
                      field("size_x", &BoundingBox2D::size_x),
                      field("size_y", &BoundingBox2D::size_y)};
  }
};

struct Detection2D {
  Header header;
  std::vector<ObjectHypothesisWithPose> results;
  BoundingBox2D bbox;
  std::string id;

  static constexpr std::string_view kType = "vision_msgs/msg/Detection2D";
  static constexpr auto members() {
    return std::tuple{field("header", &Detection2D::header),
                      field("results", &Detection2D::results), field("bbox", &Detection2D::bbox),
                      field("id", &Detection2D::id)};
  }
};

struct Detection2DArray {
  Header header;
  std::vector<Detection2D> detections;

  static constexpr std::string_view kType = "vision_msgs/msg/Detection2DArray";
  static constexpr auto members() {
    return std::tuple{field("header", &Detection2DArray::header),
                      field("detections", &Detection2DArray::detections)};
  }
};

}  // namespace pitwall::ros
