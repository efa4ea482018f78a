// Registry rows of motion: position, velocity, acceleration, actuators.
//   frames Map and Body (ISO 8855) as in vehicle/world/ego_state.hpp; track offset left positive;
//          steering at the road wheel, left positive
//   source AV-21: top speed below 100 m/s; wheel speed in steps of 0.1 km/h; steering motor of
//          +-512 deg in steps of 0.5 deg behind a ratio of 19.5, so +-0.458 rad in steps of
//          0.00045; brake pressure of 13 bits in kPa; six gears. A step is half of the accuracy of
//          the sensor or the estimate: GNSS with RTK 0.02 m, dual-antenna heading 0.002 rad,
//          acceleration 0.01 g
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "protocol/telemetry/registry/rows.hpp"

namespace pitwall::telemetry::rows {

constexpr FieldRow steering(Group group) { return {group, "steering", "rad", -0.46, 0.46, 0.0004}; }
constexpr FieldRow gear(Group group) { return {group, "gear", "", 0, 6, 1}; }
constexpr FieldRow pressure(Group group, std::string_view name) {
  return {group, name, "kPa", 0, 8'176, 8};
}
constexpr FieldRow acceleration(std::string_view name) {
  return {Group::kDynamics, name, "m/s^2", -51, 51, 0.1};
}

inline constexpr auto kMotionRows = [] {
  using enum Group;
  constexpr double kHalfTurn = 3.1416;
  return std::to_array<FieldRow>({
      {kEgo, "x", "m", -5'000, 5'000, 0.02},
      {kEgo, "y", "m", -5'000, 5'000, 0.02},
      {kEgo, "yaw", "rad", -kHalfTurn, kHalfTurn, 0.0008},
      {kEgo, "vx", "m/s", -20, 120, 0.02},
      {kEgo, "vy", "m/s", -40, 40, 0.02},
      {kEgo, "yaw_rate", "rad/s", -4, 4, 0.002},
      {kEgo, "position_sigma", "m", 0, 20, 0.01},
      choice(kEgo, "validity", kValidities, 6),

      {kTrack, "station", "m", 0, 13'000, 0.1},
      {kTrack, "offset", "m", -40, 40, 0.02},
      {kTrack, "lap", "", 0, 1'000, 1},
      {kTrack, "last_lap_time", "s", 0, 520, 0.002},
      speed(kTrack, "target_speed"),

      steering(kCommand),
      share(kCommand, "throttle"),
      pressure(kCommand, "brake"),
      gear(kCommand),
      yes_no(kCommand, "actuate"),  // sent to the actuators
      yes_no(kCommand, "limited"),  // its slew rate was limited

      steering(kFeedback),
      share(kFeedback, "throttle"),
      pressure(kFeedback, "brake_front"),
      pressure(kFeedback, "brake_rear"),
      gear(kFeedback),

      speed(kWheels, "front_left"),
      speed(kWheels, "front_right"),
      speed(kWheels, "rear_left"),
      speed(kWheels, "rear_right"),
      yes_no(kWheels, "standstill"),

      acceleration("forward"),  // specific force
      acceleration("left"),
      acceleration("up"),
      {kDynamics, "roll_rate", "rad/s", -2, 2, 0.004},
      {kDynamics, "pitch_rate", "rad/s", -2, 2, 0.004},
      {kDynamics, "roll", "rad", -0.6, 0.6, 0.0012},
      {kDynamics, "pitch", "rad", -0.25, 0.25, 0.001},
      {kDynamics, "bank", "rad", -0.6, 0.6, 0.0012},  // of the track; Talladega has 0.58
      {kDynamics, "lateral_error", "m", -10, 10, 0.02},
      {kDynamics, "heading_error", "rad", -0.5, 0.5, 0.002},
      {kDynamics, "speed_error", "m/s", -102, 102, 0.4},
  });
}();

}  // namespace pitwall::telemetry::rows
