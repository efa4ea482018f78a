// DDS names of the topics and types of ROS 2.
//     /vehicle/odom           rt/vehicle/odom
//     nav_msgs/msg/Odometry   nav_msgs::msg::dds_::Odometry_
//   errors a Problem for a topic that ROS 2 would refuse, with the reason
//   source ros2/rmw_fastrtps: namespace_prefix.cpp, demangle.cpp; rmw: validate_full_topic_name
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::ros {

inline constexpr std::size_t kTopicMax = 247;  // 255 of DDS minus the prefixes of rmw

Result<std::string, Problem> dds_topic(std::string_view topic);
// `type` is the kType of a message.
std::string dds_type(std::string_view type);

}  // namespace pitwall::ros
