// Messages of radar_msgs: what one scan of a radar returned. Metres, radians, m/s, dB.
//   signs  azimuth: counter-clockwise positive (REP 103). doppler_velocity: positive while the
//          distance grows, which the file does not say and its maintainers do (issue 11)
//   source ros-perception/radar_msgs 0.2 (RadarScan, RadarReturn)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/ros/message.hpp"
#include "protocol/ros/messages/std.hpp"

namespace pitwall::ros {

struct RadarReturn {
  float range = 0.0F;
  float azimuth = 0.0F;
  float elevation = 0.0F;
  float doppler_velocity = 0.0F;
  float amplitude = 0.0F;

  static constexpr std::string_view kType = "radar_msgs/msg/RadarReturn";
  static constexpr auto members() {
    return std::tuple{field("range", &RadarReturn::range), field("azimuth", &RadarReturn::azimuth),
                      field("elevation", &RadarReturn::elevation),
                      field("doppler_velocity", &RadarReturn::doppler_velocity),
                      field("amplitude", &RadarReturn::amplitude)};
  }
};

struct RadarScan {
  Header header;
  std::vector<RadarReturn> returns;

  static constexpr std::string_view kType = "radar_msgs/msg/RadarScan";
  static constexpr auto members() {
    return std::tuple{field("header", &RadarScan::header), field("returns", &RadarScan::returns)};
  }
};

}  // namespace pitwall::ros
