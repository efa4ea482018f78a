// Parameters of localization with their legal ranges: antenna positions, noise of the sensors,
// limits of validity.
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
  LeverArm antenna;                  // primary antenna from the centre of gravity: +-5 m
  double baseline_yaw_rad = kUnset;  // -pi..pi: direction of the antenna baseline in Body, from x
                                     // counter-clockwise
  double baseline_m = kUnset;        // 0.2..5: distance of the antennas
  LeverArm imu{};                    // IMU from the centre of gravity: +-5 m
};

struct Params {
  std::array<UnitParams, world::kGnssUnits> units;
  FilterParams filter;
  CheckParams checks;
  Priorities priorities;
  double position_sigma_max_m = kUnset;   // a worse solution is refused
  double heading_sigma_max_rad = kUnset;  // a worse solution is refused
  // Without an IMU the yaw rate is computed from the steering angle with these.
  double steering_ratio = kUnset;  // motor angle : road-wheel angle
  steering::Bicycle bicycle;
  double imu_timeout_s = kUnset;         // after it the IMU of the other unit is used
  double good_age_max_s = kUnset;        // age of the last position for kGood
  double dead_reckoning_max_s = kUnset;  // after it the state is kLost
  double good_sigma_max_m = kUnset;
  double lost_sigma_max_m = kUnset;
  double reset_after_s = kUnset;  // refusal of all positions for so long restarts the filter
  world::MonitorSet off{};        // set by the bench only, not by a car file
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

// Copied from the parameters of the gateway: neither it nor the bicycle is in a section of
// localization.
inline constexpr auto kGeometryRanges = std::to_array<world::NamedRange<Params>>({
    {"steering_ratio", &Params::steering_ratio, world::kSteeringRatio.least,
     world::kSteeringRatio.most},
});

// At start-up: checks every parameter against its legal range; the place of a Problem is the name
// of the parameter.
Result<Params, Problem> checked(const Params& params);

}  // namespace pitwall::localization
