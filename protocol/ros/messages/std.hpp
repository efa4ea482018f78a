// Messages of builtin_interfaces and std_msgs.
//   source the .msg files of ROS 2 Jazzy; a test compares names, types and constants with them
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/ros/message.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::ros {

struct Time {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;

  static constexpr std::string_view kType = "builtin_interfaces/msg/Time";
  static constexpr auto members() {
    return std::tuple{field("sec", &Time::sec), field("nanosec", &Time::nanosec)};
  }
};

inline Time time_of(UtcTime at) {
  const std::int64_t sec = at.ns / kNanosecondsPerSecond;
  return {static_cast<std::int32_t>(sec),
          static_cast<std::uint32_t>(at.ns - sec * kNanosecondsPerSecond)};
}

struct Duration {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;

  static constexpr std::string_view kType = "builtin_interfaces/msg/Duration";
  static constexpr auto members() {
    return std::tuple{field("sec", &Duration::sec), field("nanosec", &Duration::nanosec)};
  }
};

struct Header {
  Time stamp;
  std::string frame_id;

  static constexpr std::string_view kType = "std_msgs/msg/Header";
  static constexpr auto members() {
    return std::tuple{field("stamp", &Header::stamp), field("frame_id", &Header::frame_id)};
  }
};

struct ColorRGBA {
  float r = 0.0F;
  float g = 0.0F;
  float b = 0.0F;
  float a = 0.0F;

  static constexpr std::string_view kType = "std_msgs/msg/ColorRGBA";
  static constexpr auto members() {
    return std::tuple{field("r", &ColorRGBA::r), field("g", &ColorRGBA::g),
                      field("b", &ColorRGBA::b), field("a", &ColorRGBA::a)};
  }
};

struct String {
  std::string data;

  static constexpr std::string_view kType = "std_msgs/msg/String";
  static constexpr auto members() { return std::tuple{field("data", &String::data)}; }
};

struct Float32 {
  float data = 0.0F;

  static constexpr std::string_view kType = "std_msgs/msg/Float32";
  static constexpr auto members() { return std::tuple{field("data", &Float32::data)}; }
};

}  // namespace pitwall::ros
