// What localization is told at start-up: where the antennas are, how noisy the sensors, when to
// give up. Every number has its legal range beside it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/localization/checks/check_params.hpp"
#include "vehicle/autonomy/localization/filter_params.hpp"
#include "vehicle/autonomy/localization/measurement.hpp"
#include "vehicle/world/monitor.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::localization {

struct UnitParams {
  LeverArm antenna;                  // of the primary antenna, from the centre of gravity: +-5 m
  double baseline_yaw_rad = kUnset;  // -pi..pi: direction of the antenna baseline in Body, from x
                                     // counter-clockwise
  double baseline_m = kUnset;        // 0.2..5: between the antennas
  LeverArm imu{};                    // of the inertial unit, from the centre of gravity: +-5 m
};

struct Params {
  std::array<UnitParams, world::kGnssUnits> units;
  FilterParams filter;
  CheckParams checks;
  Priorities priorities;
  double position_sigma_max_m = kUnset;   // 0.05..20: a worse solution is refused
  double heading_sigma_max_rad = kUnset;  // 0.005..0.5: a worse solution is refused
  // Without any IMU the yaw rate comes from the steering: how the car turns at a steering angle.
  double steering_ratio = kUnset;           // 5..40: motor angle : road-wheel angle
  double wheelbase_m = kUnset;              // 1..5
  double understeer_rad_per_mps2 = kUnset;  // -0.005..0.02: of the steady-state bicycle
  double imu_timeout_s = kUnset;            // 0.02..0.5: then the other unit's IMU
  double good_age_max_s = kUnset;           // 0.1..2: of the last position for kGood
  double dead_reckoning_max_s = kUnset;     // 0.5..20: then kLost
  double good_sigma_max_m = kUnset;         // 0.05..5
  double lost_sigma_max_m = kUnset;         // 0.5..50
  double reset_after_s = kUnset;            // 0.5..10: positions refused so long restart the filter
  world::MonitorSet off{};                  // of the bench alone: no car file sets it
};

// Start-up: every parameter against its legal range; the place is the parameter's name.
Result<Params, Problem> checked(const Params& params);

}  // namespace pitwall::localization
