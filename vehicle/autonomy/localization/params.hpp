// Parameters of localization: antenna positions, noise of the sensors, limits for giving up. Each
// number has its legal range in a table.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/localization/checks/check_params.hpp"
#include "vehicle/autonomy/localization/filter/filter_params.hpp"
#include "vehicle/autonomy/localization/filter/measurement.hpp"
#include "vehicle/steering/learned_steering.hpp"
#include "vehicle/world/legal_range.hpp"
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
  double position_sigma_max_m = kUnset;   // a worse solution is refused
  double heading_sigma_max_rad = kUnset;  // a worse solution is refused
  // Without any IMU the yaw rate comes from the steering: how the car turns at a steering angle.
  double steering_ratio = kUnset;  // motor angle : road-wheel angle
  steering::Bicycle bicycle;
  double imu_timeout_s = kUnset;         // then the other unit's IMU
  double good_age_max_s = kUnset;        // of the last position for kGood
  double dead_reckoning_max_s = kUnset;  // then kLost
  double good_sigma_max_m = kUnset;
  double lost_sigma_max_m = kUnset;
  double reset_after_s = kUnset;  // positions refused so long restart the filter
  world::MonitorSet off{};        // of the bench alone: no car file sets it
};

inline constexpr auto kRanges = std::to_array<world::NamedRange<Params>>({
    {"position_sigma_max_m", &Params::position_sigma_max_m, 0.05, 20.0},
    {"heading_sigma_max_rad", &Params::heading_sigma_max_rad, 0.005, 0.5},
    {"imu_timeout_s", &Params::imu_timeout_s, 0.02, 0.5},
    {"good_age_max_s", &Params::good_age_max_s, 0.1, 2.0},
    {"dead_reckoning_max_s", &Params::dead_reckoning_max_s, 0.5, 20.0},
    {"good_sigma_max_m", &Params::good_sigma_max_m, 0.05, 5.0},
    {"lost_sigma_max_m", &Params::lost_sigma_max_m, 0.5, 50.0},
    {"reset_after_s", &Params::reset_after_s, 0.5, 10.0},
});

// A copy of what the gateway is told; no section of localization has it, nor the bicycle.
inline constexpr auto kGeometryRanges = std::to_array<world::NamedRange<Params>>({
    {"steering_ratio", &Params::steering_ratio, world::kSteeringRatio.least,
     world::kSteeringRatio.most},
});

// Start-up: every parameter against its legal range; the place is the parameter's name.
Result<Params, Problem> checked(const Params& params);

}  // namespace pitwall::localization
