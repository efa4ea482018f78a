// Parameters of localization's filters with their legal ranges; the rear axle's two have theirs in
// steering::Bicycle.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/autonomy/localization/filter/ekf.hpp"
#include "vehicle/autonomy/localization/filter/ekf_3d.hpp"
#include "vehicle/autonomy/localization/filter/ekf_planar.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::localization {

enum class FilterKind : std::uint8_t { kPlanar, kSpatial };
inline constexpr std::array<const char*, 2> kFilterKindNames{"planar", "spatial"};

struct FilterParams {
  FilterKind kind = FilterKind::kSpatial;
  double window_s = kUnset;     // largest delay of a measurement
  double reentry_mps = kUnset;  // speed limit of corrections of the published position
  PlanarParams planar;
  SpatialParams spatial;
};

// The list of measurements has room for slightly more at their rates (filter_window.hpp).
inline constexpr double kWindowLeast_s = 0.05, kWindowMost_s = 1.1;

inline constexpr auto kFilterRanges = std::to_array<world::NamedRange<FilterParams>>({
    {"window_s", &FilterParams::window_s, kWindowLeast_s, kWindowMost_s},
    {"reentry_mps", &FilterParams::reentry_mps, 0.5, 5.0},
});

inline constexpr double kGateLeast = 4.0, kGateMost = 100.0;  // limits of every NIS gate

inline constexpr auto kMotionNoiseRanges = std::to_array<world::NamedRange<MotionNoise>>({
    {"gyro_rad_per_sqrt_s", &MotionNoise::gyro_rad_per_sqrt_s, 1e-5, 0.1},
    {"accel_mps_per_sqrt_s", &MotionNoise::accel_mps_per_sqrt_s, 1e-3, 5.0},
    {"lateral_mps_per_sqrt_s", &MotionNoise::lateral_mps_per_sqrt_s, 1e-3, 5.0},
    {"gyro_bias_rad_per_s_sqrt_s", &MotionNoise::gyro_bias_rad_per_s_sqrt_s, 1e-7, 0.01},
    {"position_m_per_sqrt_s", &MotionNoise::position_m_per_sqrt_s, 0.0, 1.0},
});

inline constexpr auto kPlanarRanges = std::to_array<world::NamedRange<PlanarParams>>({
    {"position_sigma_floor_m", &PlanarParams::position_sigma_floor_m, 0.001, 1.0},
    {"velocity_sigma_mps", &PlanarParams::velocity_sigma_mps, 0.01, 2.0},
    {"heading_sigma_floor_rad", &PlanarParams::heading_sigma_floor_rad, 0.0005, 0.2},
    {"wheel_sigma_mps", &PlanarParams::wheel_sigma_mps, 0.01, 2.0},
    {"wheel_sigma_per_speed", &PlanarParams::wheel_sigma_per_speed, 0.0, 0.1},
    {"slip_sigma_mps", &PlanarParams::slip_sigma_mps, 0.05, 5.0},
    {"slip_after_s", &PlanarParams::slip_after_s, 0.05, 5.0},
});

inline constexpr auto kSpatialRanges = std::to_array<world::NamedRange<SpatialParams>>({
    {"gyro_rad_per_sqrt_s", &SpatialParams::gyro_rad_per_sqrt_s, 1e-6, 0.1},
    {"accel_mps_per_sqrt_s", &SpatialParams::accel_mps_per_sqrt_s, 1e-4, 5.0},
    {"gyro_bias_rad_per_s_sqrt_s", &SpatialParams::gyro_bias_rad_per_s_sqrt_s, 1e-8, 0.01},
    {"accel_bias_mps2_sqrt_s", &SpatialParams::accel_bias_mps2_sqrt_s, 1e-7, 0.1},
    {"gyro_bias_start_rad_per_s", &SpatialParams::gyro_bias_start_rad_per_s, 1e-5, 0.1},
    {"accel_bias_start_mps2", &SpatialParams::accel_bias_start_mps2, 1e-4, 1.0},
    {"gyro_scale_start", &SpatialParams::gyro_scale_start, 1e-6, 0.05},
    {"accel_scale_start", &SpatialParams::accel_scale_start, 1e-6, 0.05},
    {"reacquire_s", &SpatialParams::reacquire_s, 0.1, 5.0},
    {"position_wander_share", &SpatialParams::position_wander_share, 0.0, 0.999},
    {"position_wander_s", &SpatialParams::position_wander_s, 1.0, 1000.0},
    {"position_wander_together", &SpatialParams::position_wander_together, 0.0, 0.99},
    {"position_sigma_floor_m", &SpatialParams::position_sigma_floor_m, 0.0005, 1.0},
    {"velocity_sigma_mps", &SpatialParams::velocity_sigma_mps, 0.005, 2.0},
    {"vertical_velocity_sigma_mps", &SpatialParams::vertical_velocity_sigma_mps, 0.005, 2.0},
    {"heading_sigma_floor_rad", &SpatialParams::heading_sigma_floor_rad, 0.0001, 0.2},
    {"heading_correlation_s", &SpatialParams::heading_correlation_s, 0.01, 60.0},
    {"model_correlation_s", &SpatialParams::model_correlation_s, 0.01, 10.0},
    {"wheel_sigma_mps", &SpatialParams::wheel_sigma_mps, 0.01, 2.0},
    {"wheel_sigma_per_speed", &SpatialParams::wheel_sigma_per_speed, 0.0, 0.1},
    {"slip_sigma_mps", &SpatialParams::slip_sigma_mps, 0.05, 5.0},
    {"road_tilt_sigma_rad", &SpatialParams::road_tilt_sigma_rad, 0.0005, 0.5},
    {"road_height_sigma_m", &SpatialParams::road_height_sigma_m, 0.005, 10.0},
    {"road_normal_sigma_mps", &SpatialParams::road_normal_sigma_mps, 0.01, 5.0},
    {"cg_height_m", &SpatialParams::cg_height_m, -0.5, 1.0},
    {"attitude_sigma_floor_rad", &SpatialParams::attitude_sigma_floor_rad, 0.0005, 0.5},
});

// Problem of the first parameter outside its range (NaN is outside); the place is "filter." and its
// name. nullopt if all are legal.
std::optional<Problem> illegal(const FilterParams& params);

}  // namespace pitwall::localization
