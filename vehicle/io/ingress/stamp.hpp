// Age of a ROS 2 message by its header.stamp.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/ros/messages/std.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::io {

inline Duration age_of(const ros::Header& header, UtcTime now) {
  return Duration{now.ns - header.stamp.sec * kNanosecondsPerSecond -
                  static_cast<std::int64_t>(header.stamp.nanosec)};
}

}  // namespace pitwall::io
