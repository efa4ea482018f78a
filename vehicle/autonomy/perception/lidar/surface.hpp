// Whether a ray met a surface: the ray before or after it in its ring then met the same one. In
// dust each goes as far as it likes.
//   in     points of a sweep in the order of their rays
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "vehicle/autonomy/perception/lidar/point_cloud.hpp"

namespace pitwall::perception {

// How far apart two rays on one surface are, and how much more for each metre of range.
inline constexpr double kNextPoint_m = 0.15, kNextPointShare = 0.004;

inline bool has_surface(std::span<const LidarPoint> sweep, std::size_t i) {
  const LidarPoint& p = sweep[i];
  const double near_m = kNextPoint_m + kNextPointShare * std::hypot(p.x_m, p.y_m);
  const auto is_next = [&](const LidarPoint& other) {
    return std::hypot(p.x_m - other.x_m, p.y_m - other.y_m, p.z_m - other.z_m) < near_m;
  };
  return (i > 0 && is_next(sweep[i - 1])) || (i + 1 < sweep.size() && is_next(sweep[i + 1]));
}

}  // namespace pitwall::perception
