// Plausibility limits of receiver values, applied even if the checksum is right.
//   in     finite numbers (the decoders refuse others)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

#include "vehicle/world/sensor_input.hpp"

namespace pitwall::receivers {

inline constexpr double kMaxSpeed_mps = 150.0, kMaxHeight_m = 10'000.0;

inline bool is_place(double latitude_deg, double longitude_deg, double height_m) {
  return std::fabs(latitude_deg) <= 90.0 && std::fabs(longitude_deg) <= 180.0 &&
         std::fabs(height_m) <= kMaxHeight_m;
}

inline bool is_velocity(double horizontal_mps, double track_deg, double vertical_mps) {
  return horizontal_mps >= 0.0 && horizontal_mps <= kMaxSpeed_mps &&
         std::fabs(vertical_mps) <= kMaxSpeed_mps && std::fabs(track_deg) <= 360.0;
}

inline bool is_heading(double heading_deg) { return std::fabs(heading_deg) <= 360.0; }

inline bool is_attitude(const world::InsAttitude& a) {
  return std::fabs(a.roll_rad) <= std::numbers::pi &&
         std::fabs(a.pitch_rad) <= 0.5 * std::numbers::pi &&
         std::fabs(a.heading_rad) <= 2.0 * std::numbers::pi;
}

}  // namespace pitwall::receivers
