// The messages of package pitwall_msgs: one for each group of fields that the car tells, and one
// for each group that the base makes itself. A field is added in the registry and nowhere else.
//
//     tyres.pressure_rear_left   pitwall_msgs/msg/Tyres: float64 pressure_rear_left  # kPa, ...
//
//   out    type description, .msg text with units, RIHS01, CDR bytes
//   units  as the registry has them
//   invariants
//          every field is a float64, so that one that is not known is NaN and never 0; the names of
//          a choice's values are constants of the message; header.stamp is when it was sampled
//   cost   the descriptions are made once; encode_group() allocates nothing that `out` has room for
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
  std::vector<std::size_t> rows{};  // its fields' places in the registry or in the base's own table
};

// Those of the car first, in the order of the registry, then those of the base.
const std::vector<GroupMessage>& group_messages();
// Where the message of a group stands there; it must be one that the car tells.
std::size_t message_index(telemetry::Group group);

void encode_group(const ros::Header& header, std::span<const double> values,
                  std::vector<std::uint8_t>& out);

// "opponent_1" to "Opponent1".
std::string message_name(std::string_view group);
// "race ready" of the field "ct_state" to "CT_STATE_RACE_READY".
std::string constant_name(std::string_view field, std::string_view label);

}  // namespace pitwall::publishers::ros_view
