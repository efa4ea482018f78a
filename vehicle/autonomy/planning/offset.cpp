// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/offset.hpp"

#include <cmath>

namespace pitwall::planning {
namespace {

double beyond_m(const Line& line, const OffsetChange& c, double s_m) {
  return std::remainder(s_m - c.from_s_m, line.length_m);
}

}  // namespace

Offset offset_at(const Line& line, const OffsetChange& c, double s_m) {
  return offset_at(c, c.from_s_m + beyond_m(line, c, s_m));
}

Offset offset_at(const OffsetChange& c, double s_m) {
  if (!(c.length_m > 0.0)) return {c.to_m, 0.0, 0.0};
  const double u = (s_m - c.from_s_m) / c.length_m;
  if (u <= 0.0) return {c.from_m, 0.0, 0.0};
  if (u >= 1.0) return {c.to_m, 0.0, 0.0};
  const double u2 = u * u, v = 1.0 - u, l = c.length_m, rise_m = c.to_m - c.from_m;
  return {c.from_m + rise_m * u2 * u * (10.0 - 15.0 * u + 6.0 * u2), rise_m * 30.0 * u2 * v * v / l,
          rise_m * 60.0 * u * v * (1.0 - 2.0 * u) / (l * l)};
}

bool is_over(const Line& line, const OffsetChange& c, double s_m) {
  return !(c.length_m > 0.0) || beyond_m(line, c, s_m) >= c.length_m;
}

double curvature_beside(double line_curvature_per_m, const Offset& o) {
  const double stretch = 1.0 - line_curvature_per_m * o.n_m;
  const double cos_turn = stretch / std::hypot(stretch, o.slope);
  const double bend_per_m = o.bend_per_m + line_curvature_per_m * o.slope * o.slope / stretch;
  return (bend_per_m * cos_turn * cos_turn / stretch + line_curvature_per_m) * cos_turn / stretch;
}

Beside beside(const LinePoint& p, const Offset& o) {
  if (o.n_m == 0.0 && o.slope == 0.0 && o.bend_per_m == 0.0)
    return {p.x_m, p.y_m, p.yaw_rad, p.curvature_per_m};
  const double stretch = 1.0 - p.curvature_per_m * o.n_m;
  return {p.x_m - o.n_m * std::sin(p.yaw_rad), p.y_m + o.n_m * std::cos(p.yaw_rad),
          wrap_pi(p.yaw_rad + std::atan2(o.slope, stretch)),
          curvature_beside(p.curvature_per_m, o)};
}

}  // namespace pitwall::planning
