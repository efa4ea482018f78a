// Messages of diagnostic_msgs: status of components, as rqt_robot_monitor shows it.
//   source the .msg files of ROS 2 Jazzy; a test compares names, types and constants with them
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/ros/message.hpp"
#include "protocol/ros/messages/std.hpp"

namespace pitwall::ros {

struct KeyValue {
  std::string key;
  std::string value;

  static constexpr std::string_view kType = "diagnostic_msgs/msg/KeyValue";
  static constexpr auto members() {
    return std::tuple{field("key", &KeyValue::key), field("value", &KeyValue::value)};
  }
};

struct DiagnosticStatus {
  Byte level{};
  std::string name;
  std::string message;
  std::string hardware_id;
  std::vector<KeyValue> values;

  static constexpr std::string_view kType = "diagnostic_msgs/msg/DiagnosticStatus";
  static constexpr std::array kConstants{Constant{"byte", "OK", "0"}, Constant{"byte", "WARN", "1"},
                                         Constant{"byte", "ERROR", "2"},
                                         Constant{"byte", "STALE", "3"}};
  static constexpr auto members() {
    return std::tuple{field("level", &DiagnosticStatus::level),
                      field("name", &DiagnosticStatus::name),
                      field("message", &DiagnosticStatus::message),
                      field("hardware_id", &DiagnosticStatus::hardware_id),
                      field("values", &DiagnosticStatus::values)};
  }
};

struct DiagnosticArray {
  Header header;
  std::vector<DiagnosticStatus> status;

  static constexpr std::string_view kType = "diagnostic_msgs/msg/DiagnosticArray";
  static constexpr auto members() {
    return std::tuple{field("header", &DiagnosticArray::header),
                      field("status", &DiagnosticArray::status)};
  }
};

}  // namespace pitwall::ros
