// Random ROS messages and their JSON text, for comparison with other decoders.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <random>

#include "protocol/ros/messages/diagnostic.hpp"
#include "protocol/ros/messages/nav.hpp"
#include "protocol/ros/messages/sensor.hpp"
#include "protocol/ros/messages/visualization.hpp"

namespace pitwall::ros::testing {

using Random = std::mt19937_64;

template <class T>
void fill(Random& random, T& value) {
  if constexpr (Message<T>) {
    for_each_field<T>([&](const auto& field) { fill(random, value.*field.member); });
  } else if constexpr (Sequence<T>) {
    value.resize(random() % 5);
    for (auto& item : value) fill(random, item);
  } else if constexpr (FixedArray<T>) {
    for (auto& item : value) fill(random, item);
  } else if constexpr (std::is_same_v<T, std::string>) {
    value.clear();
    for (std::size_t i = random() % 9; i > 0; --i)
      value += static_cast<char>('a' + static_cast<int>(random() % 26));
  } else if constexpr (std::is_same_v<T, bool>) {
    value = random() % 2 == 0;
  } else if constexpr (std::is_floating_point_v<T>) {
    // Multiples of one half, which every decimal notation represents exactly.
    value = static_cast<T>(static_cast<std::int64_t>(random() % 2'000'001) - 1'000'000) / 2;
  } else {
    value = static_cast<T>(random());
  }
}

template <class T>
void append_json(std::string& out, const T& value) {
  if constexpr (Message<T>) {
    out += '{';
    for_each_field<T>([&](const auto& field) {
      if (out.back() != '{') out += ',';
      out += '"' + std::string(field.name) + "\":";
      append_json(out, value.*field.member);
    });
    out += '}';
  } else if constexpr (Sequence<T> || FixedArray<T>) {
    out += '[';
    for (const auto& item : value) {
      if (out.back() != '[') out += ',';
      append_json(out, item);
    }
    out += ']';
  } else if constexpr (std::is_same_v<T, std::string>) {
    out += '"' + value + '"';
  } else if constexpr (std::is_same_v<T, bool>) {
    out += value ? "true" : "false";
  } else if constexpr (std::is_floating_point_v<T>) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", static_cast<double>(value));
    out += text;
  } else {
    out += std::to_string(static_cast<std::int64_t>(value));
  }
}

// Calls f.template operator()<M>() for every message type that we support.
template <class F>
void for_each_message(F&& f) {
  const auto each = [&f]<class... M>(std::tuple<M...>*) { (f.template operator()<M>(), ...); };
  each(static_cast<
       std::tuple<Time, ros::Duration, Header, ColorRGBA, String, Float32, Point, Vector3,
                  Quaternion, Pose, PoseStamped, PoseWithCovariance, Twist, TwistWithCovariance,
                  Transform, TransformStamped, Odometry, Path, TFMessage, NavSatStatus, NavSatFix,
                  Imu, Image, CompressedImage, PointField, PointCloud2, KeyValue, DiagnosticStatus,
                  DiagnosticArray, UVCoordinate, MeshFile, Marker, MarkerArray>*>(nullptr));
}

}  // namespace pitwall::ros::testing
