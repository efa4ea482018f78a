// Limits of the localization checks with their legal ranges: one table for start-up, the car file
// and the tests.
//   units  in the names; a limit of a comparison is in addition to the reported sigmas where its
//          comment says so
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::localization {

// Preferred unit of a channel; the other unit is used while that one is not healthy.
enum class Preference : std::uint8_t { kBoth, kUnit0, kUnit1 };
struct Priorities {
  Preference position = Preference::kBoth, velocity = Preference::kBoth,
             heading = Preference::kBoth;
  Preference imu = Preference::kUnit0;  // only one IMU is used: biases differ
};

struct CheckParams {
  // Time stamps.
  double future_max_s = 0.005;        // tolerance: receiver clocks are estimates
  double reorder_max_s = 0.12;        // allowed age relative to the newest stamp of the stream
  double spacing_min_s = 0.001;       // a stamp nearer to a used one counts as repeated
  double frozen_speed_min_mps = 2.0;  // above this speed repeated content is a fault
  // Streams.
  double position_gap_max_s = 0.125, velocity_gap_max_s = 0.125, heading_gap_max_s = 2.5,
         imu_gap_max_s = 0.05, wheel_gap_max_s = 0.05;
  double rate_window_s = 1.0;  // a longer outage ends the trust in a unit
  // Solution.
  double position_rank_min = 1.0;  // rank_of() in evidence.hpp
  double height_sigma_max_m = 10.0;
  double differential_age_max_s = 10.0, solution_age_max_s = 1.0;
  double velocity_sigma_max_mps = 1.0;
  double attitude_sigma_max_rad = 0.1;
  double baseline_tolerance_m = 0.1;
  double sigma_ratio_max = 5.0;  // relative to the other unit, while that one is in use
  // Jumps relative to the prediction: larger than these values, and beyond so many combined sigmas.
  double jump_sigmas = 4.0;
  double jump_position_m = 0.08, jump_velocity_mps = 0.2, jump_heading_rad = 0.01;
  // Difference between the units, in addition to three combined sigmas.
  double agree_position_m = 0.08, agree_velocity_mps = 0.3, agree_heading_rad = 0.02;
  double agree_within_s = 0.2;  // largest time difference of compared residuals
  double worse_factor = 1.5;    // the refused unit deviates by this factor more
  double drift_memory_s = 5.0;  // memory of the drift detector of one unit
  double course_speed_min_mps = 10.0, course_max_rad = 0.15;
  // IMUs: relative to each other and to the rate of the course.
  double imu_rate_max_rad_per_s = 0.03, imu_force_max_mps2 = 1.5;
  double imu_contradict_s = 0.04;     // duration before one is found faulty
  double imu_offset_memory_s = 20.0;  // time constant of their constant difference
  // Wheels: relative to each other and to the car.
  double wheel_spread_mps = 0.8, wheel_spread_per_speed = 0.04;
  double wheel_speed_max_mps = 1.5, wheel_speed_max_per_speed = 0.1;
  double half_track_m = 0.82;
  // Tyre growth with speed: the wheel speeds read low by this factor times v^2 - from^2.
  double wheel_growth_s2_per_m2 = 3.8e-6, wheel_growth_from_mps = 30.0;
  double wheel_scale_memory_s = 10.0;  // time constant of the learned scale
  double wheel_scale_sigma = 0.004;    // remaining error, share of the speed
  // Trust.
  double distrust_samples = 3.0;       // consecutive refusals that end the trust
  double readmit_after_s = 1.0;        // consistent without interruption
  double readmit_alone_after_s = 0.1;  // if no other source gives the state
};

inline constexpr auto kCheckRanges = std::to_array<world::NamedRange<CheckParams>>({
    {"future_max_s", &CheckParams::future_max_s, 0.0, 0.1},
    {"reorder_max_s", &CheckParams::reorder_max_s, 0.0, 0.5},
    {"spacing_min_s", &CheckParams::spacing_min_s, 0.0, 0.004},
    {"frozen_speed_min_mps", &CheckParams::frozen_speed_min_mps, 0.5, 30.0},
    {"position_gap_max_s", &CheckParams::position_gap_max_s, 0.05, 2.0},
    {"velocity_gap_max_s", &CheckParams::velocity_gap_max_s, 0.05, 2.0},
    {"heading_gap_max_s", &CheckParams::heading_gap_max_s, 0.05, 10.0},
    {"imu_gap_max_s", &CheckParams::imu_gap_max_s, 0.01, 0.5},
    {"wheel_gap_max_s", &CheckParams::wheel_gap_max_s, 0.01, 0.5},
    {"rate_window_s", &CheckParams::rate_window_s, 0.2, 10.0},
    {"position_rank_min", &CheckParams::position_rank_min, 0.0, 3.0},
    {"height_sigma_max_m", &CheckParams::height_sigma_max_m, 0.1, 50.0},
    {"differential_age_max_s", &CheckParams::differential_age_max_s, 1.0, 120.0},
    {"solution_age_max_s", &CheckParams::solution_age_max_s, 0.1, 10.0},
    {"velocity_sigma_max_mps", &CheckParams::velocity_sigma_max_mps, 0.05, 10.0},
    {"attitude_sigma_max_rad", &CheckParams::attitude_sigma_max_rad, 0.005, 0.5},
    {"baseline_tolerance_m", &CheckParams::baseline_tolerance_m, 0.01, 1.0},
    {"sigma_ratio_max", &CheckParams::sigma_ratio_max, 2.0, 100.0},
    {"jump_sigmas", &CheckParams::jump_sigmas, 2.0, 10.0},
    {"jump_position_m", &CheckParams::jump_position_m, 0.02, 1.0},
    {"jump_velocity_mps", &CheckParams::jump_velocity_mps, 0.05, 2.0},
    {"jump_heading_rad", &CheckParams::jump_heading_rad, 0.002, 0.2},
    {"agree_position_m", &CheckParams::agree_position_m, 0.02, 1.0},
    {"agree_velocity_mps", &CheckParams::agree_velocity_mps, 0.05, 2.0},
    {"agree_heading_rad", &CheckParams::agree_heading_rad, 0.002, 0.2},
    {"agree_within_s", &CheckParams::agree_within_s, 0.05, 2.0},
    {"worse_factor", &CheckParams::worse_factor, 1.0, 5.0},
    {"drift_memory_s", &CheckParams::drift_memory_s, 1.0, 60.0},
    {"course_speed_min_mps", &CheckParams::course_speed_min_mps, 3.0, 30.0},
    {"course_max_rad", &CheckParams::course_max_rad, 0.05, 1.0},
    {"imu_rate_max_rad_per_s", &CheckParams::imu_rate_max_rad_per_s, 0.005, 0.5},
    {"imu_force_max_mps2", &CheckParams::imu_force_max_mps2, 0.2, 20.0},
    {"imu_contradict_s", &CheckParams::imu_contradict_s, 0.0, 0.5},
    {"imu_offset_memory_s", &CheckParams::imu_offset_memory_s, 1.0, 120.0},
    {"wheel_spread_mps", &CheckParams::wheel_spread_mps, 0.1, 10.0},
    {"wheel_spread_per_speed", &CheckParams::wheel_spread_per_speed, 0.0, 0.3},
    {"wheel_speed_max_mps", &CheckParams::wheel_speed_max_mps, 0.1, 10.0},
    {"wheel_speed_max_per_speed", &CheckParams::wheel_speed_max_per_speed, 0.0, 0.5},
    {"half_track_m", &CheckParams::half_track_m, 0.3, 1.5},
    {"wheel_growth_s2_per_m2", &CheckParams::wheel_growth_s2_per_m2, 0.0, 2e-5},
    {"wheel_growth_from_mps", &CheckParams::wheel_growth_from_mps, 0.0, 60.0},
    {"wheel_scale_memory_s", &CheckParams::wheel_scale_memory_s, 1.0, 120.0},
    {"wheel_scale_sigma", &CheckParams::wheel_scale_sigma, 0.0005, 0.05},
    {"distrust_samples", &CheckParams::distrust_samples, 1.0, 50.0},
    {"readmit_after_s", &CheckParams::readmit_after_s, 0.0, 30.0},
    {"readmit_alone_after_s", &CheckParams::readmit_alone_after_s, 0.0, 5.0},
});

// Problem of the first limit outside its range (NaN is outside); the place is "checks." and its
// name. nullopt if all are legal.
std::optional<Problem> illegal(const CheckParams& params);

}  // namespace pitwall::localization
