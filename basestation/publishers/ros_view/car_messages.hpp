// Conversion of the car's state to standard ROS 2 messages.
//   in     the state as received by radio; times on the base's clock, and the offset of UTC to it
//   out    messages; nullopt if the state has no data for one
//   frames map, base_link at the centre of gravity (ISO 8855, REP 103, REP 105)
//   units  of REP 103; header.stamp is when the car took the sample, in UTC
//   absent odometry, its transform and the fused fix need a valid position and heading; otherwise
//          they are not sent. An unknown height, roll or pitch is that of the map's plane, 0, with
//          a variance of kUnknownVariance; any other unknown value is NaN with that variance
//          (Odometry) or with -1 as first element of its covariance (Imu). A receiver without a
//          solution has STATUS_NO_FIX; the radio does not carry the positions of the receivers, so
//          latitude and longitude of /gnss/... are NaN
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "basestation/publishers/ros_view/ground.hpp"
#include "basestation/state/course.hpp"
#include "protocol/ros/messages/nav.hpp"
#include "protocol/ros/messages/sensor.hpp"
#include "protocol/telemetry/registry/registry.hpp"

namespace pitwall::publishers::ros_view {

inline constexpr double kUnknownVariance = 1e6;
inline constexpr double kRacelineStep_m = 5.0;

struct Frames {
  std::string map = "map", base = "base_link";
};

class CarMessages {
 public:
  CarMessages(Frames frames, Duration utc_minus_base)
      : frames_(std::move(frames)), utc_minus_base_(utc_minus_base) {}

  std::optional<ros::Odometry> odometry(const telemetry::Snapshot& state) const;
  std::optional<ros::TFMessage> transform(const telemetry::Snapshot& state) const;
  std::optional<ros::NavSatFix> fix(const telemetry::Snapshot& state, const Ground& ground) const;
  std::optional<ros::Imu> imu(const telemetry::Snapshot& state) const;
  // `unit`: 0 (the top receiver) or 1.
  ros::NavSatFix receiver_fix(const telemetry::Snapshot& state, std::size_t unit) const;

  ros::Header header(Instant at, const std::string& frame) const;
  const Frames& frames() const { return frames_; }

 private:
  Frames frames_;
  Duration utc_minus_base_;
};

// Reference line of the track, closed.
ros::Path raceline(const state::Course& course, const ros::Header& header);

}  // namespace pitwall::publishers::ros_view
