// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/offset.hpp"

#include <cmath>

namespace pitwall::planning {
namespace {

double beyond_m(const Line& line, const OffsetChange& c, double s_m) {
  return std::remainder(s_m - c.from_s_m, line.length_m);
}

// What slope and bend at the begin add.
Offset of_the_begin(const OffsetChange& c, double u) {
  const double u2 = u * u, u3 = u2 * u, l = c.length_m;
  const double slope_m = c.from_slope * l, bend_m = c.from_bend_per_m * l * l;
  return {slope_m * (u - u3 * (6.0 - 8.0 * u + 3.0 * u2)) +
              bend_m * 0.5 * (u2 - u3 * (3.0 - 3.0 * u + u2)),
          (slope_m * (1.0 - u2 * (18.0 - 32.0 * u + 15.0 * u2)) +
           bend_m * 0.5 * (2.0 * u - u2 * (9.0 - 12.0 * u + 5.0 * u2))) /
              l,
          (slope_m * -u * (36.0 - 96.0 * u + 60.0 * u2) +
           bend_m * 0.5 * (2.0 - u * (18.0 - 36.0 * u + 20.0 * u2))) /
              (l * l)};
}

}  // namespace

Offset offset_at(const Line& line, const OffsetChange& c, double s_m) {
  return offset_at(c, c.from_s_m + beyond_m(line, c, s_m));
}

Offset offset_at(const OffsetChange& c, double s_m) {
  if (!(c.length_m > 0.0)) return {c.to_m, 0.0, 0.0};
  const double u = (s_m - c.from_s_m) / c.length_m;
  if (u <= 0.0) return {c.from_m, c.from_slope, c.from_bend_per_m};
  if (u >= 1.0) return {c.to_m, 0.0, 0.0};
  const double u2 = u * u, v = 1.0 - u, l = c.length_m, rise_m = c.to_m - c.from_m;
  return Offset{c.from_m + rise_m * u2 * u * (10.0 - 15.0 * u + 6.0 * u2),
                rise_m * 30.0 * u2 * v * v / l, rise_m * 60.0 * u * v * (1.0 - 2.0 * u) / (l * l)} +
         of_the_begin(c, u);
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

// The inverse of beside() and curvature_beside().
Offset offset_of(const LinePoint& p, double beside_m, double path_yaw_rad,
                 double path_curvature_per_m) {
  const double stretch = 1.0 - p.curvature_per_m * beside_m;
  const double turn_rad = wrap_pi(path_yaw_rad - p.yaw_rad);
  const double slope = stretch * std::tan(turn_rad), cos_turn = std::cos(turn_rad);
  const double bend_per_m = (path_curvature_per_m * stretch / cos_turn - p.curvature_per_m) *
                                stretch / (cos_turn * cos_turn) -
                            p.curvature_per_m * slope * slope / stretch;
  return {beside_m, slope, bend_per_m};
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
