// Parameters of a receiver with its inertial unit: mounting place and measurement errors. The
// source of every number is in README.md beside this file.
//   units  noise: one standard deviation per axis, unless stated otherwise
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <numbers>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::sensors {

// Position in Body: x forward, y left, z up, from the centre of gravity.
struct Lever {
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
};

struct PositionNoise {
  double sigma_m = 0.010;     // RTK fixed, total
  double white_share = 0.1;   // of the variance; the rest wanders
  double common_share = 0.6;  // of the wandering part: common to all units
  double correlation_s = 30.0;
  double float_sigma_m = 0.15, single_sigma_m = 1.2;
  double height_factor = 1.7;      // multiplies each of these deviations for the height
  double corrections_age_s = 0.6;  // smallest differential age; corrections arrive once a second
};

struct VelocityNoise {
  double sigma_mps = 0.03, vertical_sigma_mps = 0.05;
};

struct HeadingNoise {
  double sigma_rad_m = 0.0028;  // divided by the length of the baseline
  double wander_share = 0.5;    // of the variance
  double correlation_s = 10.0;
  double baseline_sigma_m = 0.005;
};

struct ImuNoise {
  double gyro_rad_per_sqrt_s = 2.9e-5;         // angle random walk
  double gyro_vibration_rad_per_s = 0.0015;    // vibration of the car, per sample
  double gyro_turn_on_rad_per_s = 8.7e-4;      // constant during a run
  double gyro_instability_rad_per_s = 1.7e-5;  // wanders
  double gyro_scale = 1e-3, gyro_range_rad_per_s = 2.618;
  double accel_mps_per_sqrt_s = 8.3e-4;  // velocity random walk
  double accel_vibration_mps2 = 0.05;
  double accel_turn_on_mps2 = 0.03;
  double accel_instability_mps2 = 9.8e-4;
  double accel_scale = 1e-3, accel_range_mps2 = 49.0;
  double instability_correlation_s = 200.0;
};

// Inertial solution of the receiver.
struct InsNoise {
  double tilt_sigma_rad = 3.5e-4, heading_sigma_rad = 1.4e-3;
  double correlation_s = 60.0;
  double aligned_above_mps = 5.0;  // it aligns by moving
};

struct UnitNoise {
  PositionNoise position;
  VelocityNoise velocity;
  HeadingNoise heading;
  ImuNoise imu;
  InsNoise ins;
};

// NovAtel PwrPak7D-E1: the defaults above. VectorNav VN-310: a better gyro, a slightly worse
// antenna heading.
constexpr UnitNoise pwrpak7d_e1() { return {}; }
constexpr UnitNoise vn310() {
  UnitNoise n;
  n.velocity = {.sigma_mps = 0.05, .vertical_sigma_mps = 0.05};
  n.heading.sigma_rad_m = 0.0035;
  n.imu.gyro_rad_per_sqrt_s = 1.6e-5;
  n.imu.gyro_instability_rad_per_s = 4.8e-6;
  n.imu.gyro_range_rad_per_s = 7.0;
  n.imu.accel_mps_per_sqrt_s = 3.9e-4;
  n.imu.accel_instability_mps2 = 9.8e-5;
  n.imu.accel_range_mps2 = 147.0;
  return n;
}

// Rate of a stream, and delay of a sample to the car's computer: `latency` plus a jitter with an
// exponential distribution.
struct Cadence {
  Duration period{}, latency{};
  double jitter_mean_s = 0.0;
};

struct UnitParams {
  Lever antenna;                  // phase centre of the primary antenna
  double baseline_yaw_rad = 0.0;  // primary to secondary antenna, from body x, left positive
  double baseline_m = 1.0;
  Duration position_phase{};  // of the first epoch after time zero
  Duration imu_phase{};
  Lever imu;
  UnitNoise noise;
};

// Antennas of the AV-21 as published, from the rear axle and the ground: top 1.242 / 0 / 0.956 m,
// front 3.175 / 0 / 0.408, right 2.005 / -0.497 / 0.389, left. The assignment is assumed: unit 0
// has top and front, unit 1 right and left, the primary antenna first. The places of the units
// themselves are assumed as well.
constexpr std::array<UnitParams, 2> av21_units() {
  return {UnitParams{.antenna = {-0.005, 0.0, 0.676},
                     .baseline_yaw_rad = 0.0,
                     .baseline_m = 1.933,
                     .position_phase = milliseconds(10),
                     .imu_phase = milliseconds(1),
                     .imu = {-0.2, 0.1, 0.0},
                     .noise = pwrpak7d_e1()},
          UnitParams{.antenna = {0.758, -0.497, 0.109},
                     .baseline_yaw_rad = std::numbers::pi / 2.0,
                     .baseline_m = 0.994,
                     .position_phase = milliseconds(35),
                     .imu_phase = milliseconds(5),
                     .imu = {-0.2, -0.1, 0.0},
                     .noise = pwrpak7d_e1()}};
}

}  // namespace pitwall::sensors
