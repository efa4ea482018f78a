// Registry rows of autonomy: localization, opponents, plan.
//   units  stations and offsets as in rows_motion.hpp; the age of an opponent is the age of its
//          detection
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "protocol/telemetry/registry/rows.hpp"

namespace pitwall::telemetry::rows {

constexpr std::size_t kOpponentFields = 6;
constexpr std::array<FieldRow, kOpponentFields> opponent(Group group) {
  return {{{group, "identity", "", 0, 254, 1},  // number of the car; 0: unknown
           {group, "station", "m", 0, 13'000, 0.1},
           {group, "offset", "m", -40, 40, 0.05},
           {group, "speed", "m/s", 0, 102, 0.1},
           {group, "age", "s", 0, 5, 0.02},
           {group, "position_sigma", "m", 0, 12.5, 0.05}}};
}
inline constexpr auto kOpponent1 = opponent(Group::kOpponent1);
inline constexpr auto kOpponent2 = opponent(Group::kOpponent2);
inline constexpr auto kOpponent3 = opponent(Group::kOpponent3);
inline constexpr auto kOpponent4 = opponent(Group::kOpponent4);

// What race control tells of the nearest competitor (CAN 1209): shown, and no input of the car.
inline constexpr auto kRivalRows = std::to_array<FieldRow>({
    {Group::kRival, "number", "", 0, 254, 1},
    {Group::kRival, "rank", "", 0, 14, 1},
    {Group::kRival, "laps", "", 0, 254, 1},
    {Group::kRival, "lap_distance", "m", 0, 13'000, 1},  // since the start line
    {Group::kRival, "speed", "m/s", 0, 102, 0.1},
});

inline constexpr auto kLocalizationRows = [] {
  constexpr Group kGroup = Group::kLocalization;
  return std::to_array<FieldRow>({
      {kGroup, "sigma_x", "m", 0, 20, 0.01},
      {kGroup, "sigma_y", "m", 0, 20, 0.01},
      {kGroup, "sigma_yaw", "rad", 0, 1, 0.002},
      {kGroup, "sigma_vx", "m/s", 0, 5, 0.01},
      {kGroup, "sigma_vy", "m/s", 0, 5, 0.01},
      {kGroup, "gyro_bias", "rad/s", -0.05, 0.05, 0.0002},
      {kGroup, "position_age", "s", 0, 10, 0.02},
      choice(kGroup, "position_units", kUnitSets, 6),
      choice(kGroup, "heading_units", kUnitSets, 6),
      choice(kGroup, "imu_units", kUnitSets, 6),
      count(kGroup, "accepted"),
      count(kGroup, "outliers"),
      count(kGroup, "unsolved"),
      count(kGroup, "uncertain"),
      count(kGroup, "late"),
      count(kGroup, "implausible"),
      {kGroup, "restarts", "", 0, 254, 1},
      {kGroup, "excluded", FieldRow::kBitSet, 0, 1'022, 1, kExcludableNames},  // by the operator
      choice(kGroup, "velocity_units", kUnitSets, 6),
      choice(kGroup, "imu0_verdict", kSampleVerdicts, 62),  // on the newest sample
      choice(kGroup, "imu1_verdict", kSampleVerdicts, 62),
      choice(kGroup, "wheel_verdict", kSampleVerdicts, 62),
      count(kGroup, "contradicted"),
      count(kGroup, "bad_stamps"),
      {kGroup, "height", "m", -100, 400, 0.02},  // of the centre of gravity over the datum
      {kGroup, "sigma_height", "m", 0, 20, 0.02},
  });
}();

inline constexpr auto kPlannerRows = [] {
  constexpr Group kGroup = Group::kPlanner;
  return std::to_array<FieldRow>({
      choice(kGroup, "role", kRoles, 6),
      choice(kGroup, "primitive", kPrimitives, 14),
      choice(kGroup, "reason", kSpeedReasons, 30),
      {kGroup, "line", "", 0, 30, 1},
      {kGroup, "line_offset", "m", -40, 40, 0.02},
      {kGroup, "target_gap", "m", 0, 500, 0.5},
      {kGroup, "stop_distance", "m", 0, 2'000, 1},
      {kGroup, "operator_limit", "m/s", 0, 120, 0.1},
      {kGroup, "cost", "", 0, 1'000, 0.5},
      {kGroup, "age", "s", 0, 5, 0.01},
      yes_no(kGroup, "grip_limited"),         // the tyres have less left than the pedals want
      count(kGroup, "missed_shifts", 254.0),  // asked for, and not reported by the gearbox
  });
}();

}  // namespace pitwall::telemetry::rows
