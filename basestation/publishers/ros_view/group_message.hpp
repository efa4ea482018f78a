// Messages of the package pitwall_msgs: one for each group of fields that the car sends, and one
// for each group that the base computes. A new field is added in the registry and nowhere else.
//
//     tyres.pressure_rear_left   pitwall_msgs/msg/Tyres: float64 pressure_rear_left  # kPa, ...
//
//   out    type description, .msg text with units, RIHS01, CDR bytes
//   units  as in the registry
//   invariants
//          every field is a float64, so that an unknown value is NaN and never 0; the labels of an
//          enumeration are constants of the message; header.stamp is the time of the sample
//   cost   the descriptions are made once; encode_group() allocates only if `out` is too small
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "basestation/state/station_field.hpp"
#include "protocol/ros/describe.hpp"
#include "protocol/ros/messages/std.hpp"
#include "protocol/telemetry/registry/registry.hpp"

namespace pitwall::publishers::ros_view {

inline constexpr std::string_view kPackage = "pitwall_msgs";

struct GroupMessage {
  std::string group;  // "opponent_1"
  std::string name;   // "Opponent1"
  ros::TypeDescription type;
  bool of_base = false;
  std::vector<std::size_t> rows{};  // places of its fields in the registry or the base's own table
};

// Messages of the car first, in the order of the registry, then those of the base.
const std::vector<GroupMessage>& group_messages();
// Place of a group's message in group_messages(); the car must send the group.
std::size_t message_index(telemetry::Group group);

void encode_group(const ros::Header& header, std::span<const double> values,
                  std::vector<std::uint8_t>& out);

// "opponent_1" to "Opponent1".
std::string message_name(std::string_view group);
// "race ready" of the field "ct_state" to "CT_STATE_RACE_READY".
std::string constant_name(std::string_view field, std::string_view label);

}  // namespace pitwall::publishers::ros_view
