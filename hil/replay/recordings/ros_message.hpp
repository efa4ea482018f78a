// Checks of ROS 2 messages in a bag: which are CAN frames, and whether the bytes fit their type.
//   in     type name and encapsulated CDR
//   out    the frame of can_msgs/msg/Frame and ros2_socketcan_msgs/msg/FdFrame; for every other
//          message whether it can be passed on
//   errors a text that says what is wrong. NavSatFix, Imu, Odometry and PointCloud2 are decoded
//          completely; of other types only the encapsulation is checked
//   source can_msgs/msg/Frame.msg of ros_canopen, ros2_socketcan_msgs/msg/FdFrame.msg of
//          ros2_socketcan; OMG DDSI-RTPS 2.5 section 10.2
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "hil/replay/recordings/byte_pool.hpp"
#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::traffic {

struct RosCanFrame {
  can::Frame frame;
  bool is_error = false;  // CAN error frame of the controller, not traffic
};

bool is_ros_can(std::string_view type);
Result<RosCanFrame, std::string> read_ros_can(std::string_view type, Bytes cdr);

// What is wrong with the message; nullopt if nothing is.
std::optional<std::string> fault_of(std::string_view type, Bytes cdr);

}  // namespace pitwall::traffic
