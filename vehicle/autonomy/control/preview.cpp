// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/preview.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::control {

using world::Trajectory;
using world::TrajectoryPoint;

std::optional<double> project(const Trajectory& trajectory, double x_m, double y_m) {
  const auto& points = trajectory.points;
  if (points.size() < 2 || !std::isfinite(x_m + y_m)) return std::nullopt;
  double best_m2 = std::numeric_limits<double>::infinity();
  std::optional<double> best_s_m;
  const std::size_t segments = points.size() - 1;
  for (std::size_t i = 0; i < segments; ++i) {
    const TrajectoryPoint &a = points[i], &b = points[i + 1];
    const double ux = b.x_m - a.x_m, uy = b.y_m - a.y_m, u2 = ux * ux + uy * uy;
    if (!(u2 > 0.0)) continue;
    const double free = ((x_m - a.x_m) * ux + (y_m - a.y_m) * uy) / u2;
    const double held = std::clamp(free, 0.0, 1.0);
    const double dx = x_m - a.x_m - held * ux, dy = y_m - a.y_m - held * uy;
    const double m2 = dx * dx + dy * dy;
    if (!(m2 < best_m2)) continue;
    best_m2 = m2;
    const bool beyond = (i == 0 && free < 0.0) || (i + 1 == segments && free > 1.0);
    best_s_m = a.s_m + (beyond ? free : held) * (b.s_m - a.s_m);
  }
  return best_s_m;
}

TrajectoryPoint at(const Trajectory& trajectory, double s_m) {
  const auto& points = trajectory.points;
  CHECK(!points.empty());
  const auto after = std::upper_bound(points.begin(), points.end(), s_m,
                                      [](double s, const TrajectoryPoint& p) { return s < p.s_m; });
  if (after == points.begin()) return points[0];
  if (after == points.end()) return points.back();
  const TrajectoryPoint &a = *(after - 1), &b = *after;
  const double t = (s_m - a.s_m) / (b.s_m - a.s_m);
  const auto mix = [t](double from, double to) { return from + t * (to - from); };
  return {.s_m = s_m,
          .x_m = mix(a.x_m, b.x_m),
          .y_m = mix(a.y_m, b.y_m),
          .yaw_rad = wrap_pi(a.yaw_rad + t * wrap_pi(b.yaw_rad - a.yaw_rad)),
          .curvature_per_m = mix(a.curvature_per_m, b.curvature_per_m),
          .bank_rad = mix(a.bank_rad, b.bank_rad),
          .speed_mps = mix(a.speed_mps, b.speed_mps),
          .accel_mps2 = mix(a.accel_mps2, b.accel_mps2),
          .time_s = mix(a.time_s, b.time_s),
          .room_left_m = mix(a.room_left_m, b.room_left_m),
          .room_right_m = mix(a.room_right_m, b.room_right_m)};
}

}  // namespace pitwall::control
