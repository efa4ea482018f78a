// Recommended parameters for the AV-21 and its sensors, and random numbers. For tests only.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <numbers>

#include "protocol/vocabulary/random.hpp"

#include "vehicle/autonomy/localization/params.hpp"

namespace pitwall::localization::testing {

// Sum of twelve uniform numbers: close enough to a normal distribution, within 6 sigma.
inline double draw_normal(Random& random) {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += random.uniform();
  return sum;
}

inline PlanarParams recommended_planar() {
  return {.noise = {.gyro_rad_per_sqrt_s = 5e-4,
                    .accel_mps_per_sqrt_s = 0.1,
                    .lateral_mps_per_sqrt_s = 0.3,
                    .gyro_bias_rad_per_s_sqrt_s = 5e-5,
                    .position_m_per_sqrt_s = 0.005},
          .gate_nis = {12.0, 16.0},
          .position_sigma_floor_m = 0.02,
          .velocity_sigma_mps = 0.06,
          .heading_sigma_floor_rad = 0.002,
          .wheel_sigma_mps = 0.2,
          .wheel_sigma_per_speed = 0.08,
          .slip_sigma_mps = 1.5,
          .slip_after_s = 0.3,
          .cg_to_rear_m = 1.247,
          .rear_slip_rad_per_mps2 = 0.0014};
}

inline SpatialParams recommended_spatial() {
  return {.gyro_rad_per_sqrt_s = 1.5e-4,
          .accel_mps_per_sqrt_s = 0.006,
          .gyro_bias_rad_per_s_sqrt_s = 5e-6,
          .accel_bias_mps2_sqrt_s = 5e-4,
          .gyro_bias_start_rad_per_s = 0.002,
          .accel_bias_start_mps2 = 0.06,
          .gyro_scale_start = 0.002,
          .accel_scale_start = 0.002,
          .gate_nis = {20.0, 25.0, 30.0},
          .reacquire_s = 0.2,
          .position_wander_share = 0.949,
          .position_wander_s = 30.0,
          .position_wander_together = 0.6,
          .position_sigma_floor_m = 0.001,
          .velocity_sigma_mps = 0.03,
          .vertical_velocity_sigma_mps = 0.05,
          .heading_sigma_floor_rad = 0.0003,
          .heading_correlation_s = 5.0,
          .model_correlation_s = 1.0,
          .wheel_sigma_mps = 0.15,
          .wheel_sigma_per_speed = 0.025,
          .slip_sigma_mps = 0.7,
          .cg_to_rear_m = 1.247,
          .rear_slip_rad_per_mps2 = 0.0014,
          .road_tilt_sigma_rad = 0.01,
          .road_height_sigma_m = 0.05,
          .road_normal_sigma_mps = 0.1,
          .cg_height_m = 0.28,
          .attitude_sigma_floor_rad = 0.01};
}
inline const SpatialParams kSpatialParams = recommended_spatial();

inline FilterParams recommended_filter(FilterKind kind = FilterKind::kSpatial) {
  return {.kind = kind,
          .window_s = 0.25,
          .reentry_mps = 2.0,
          .planar = recommended_planar(),
          .spatial = recommended_spatial()};
}

inline Params recommended() {
  Params p;
  p.units[0] = {.antenna = {-0.005, 0.0, 0.676}, .baseline_yaw_rad = 0.0, .baseline_m = 1.933};
  p.units[1] = {.antenna = {0.758, -0.497, 0.109},
                .baseline_yaw_rad = std::numbers::pi / 2.0,
                .baseline_m = 0.994};
  p.filter = recommended_filter();
  p.position_sigma_max_m = 1.0;
  p.heading_sigma_max_rad = 0.05;
  p.steering_ratio = 19.5, p.bicycle = {2.971, 0.0006};
  p.imu_timeout_s = 0.05;
  p.good_age_max_s = 0.3, p.dead_reckoning_max_s = 15.0;
  p.good_sigma_max_m = 0.5, p.lost_sigma_max_m = 5.0;
  p.reset_after_s = 2.0;
  return p;
}

}  // namespace pitwall::localization::testing
