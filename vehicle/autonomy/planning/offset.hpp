// Lateral offset from the line with one change to a constant value: the minimum-jerk transition
// that begins with a slope and a bend, most often zero, and ends without.
//   invariants
//          n = from + (to - from) q(u) + slope l h1(u) + bend l^2 h2(u), u in [0, 1] along the
//          change of length l; q = u^3 (10 - 15 u + 6 u^2), h1 = u - u^3 (6 - 8 u + 3 u^2),
//          h2 = u^2 / 2 - u^3 (3 - 3 u + u^2) / 2. Before its begin the offset is `from`
//   frames offset positive left; slope and bend are its derivatives along the line
//   cost   O(1)
//   source minimum-jerk quintic: Flash and Hogan, J. Neuroscience 5 (1985), eq. 12
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/planning/line.hpp"

namespace pitwall::planning {

struct Offset {
  double n_m = 0.0, slope = 0.0, bend_per_m = 0.0;
};

constexpr Offset operator+(const Offset& a, const Offset& b) {
  return {a.n_m + b.n_m, a.slope + b.slope, a.bend_per_m + b.bend_per_m};
}

// With length zero the offset is `to` everywhere.
struct OffsetChange {
  double from_s_m = kUnset, length_m = 0.0;
  double from_m = 0.0, to_m = 0.0;
  double from_slope = 0.0, from_bend_per_m = 0.0;
};

// Along a path that does not close.
Offset offset_at(const OffsetChange& change, double s_m);
// Along the closed line. A change is at most half a lap long: a station more than half a lap behind
// counts as before it.
Offset offset_at(const Line& line, const OffsetChange& change, double s_m);
// Where a path goes at a point that it passes, seen from a line there.
Offset offset_of(const LinePoint& point, double beside_m, double path_yaw_rad,
                 double path_curvature_per_m);
// Whether s is past the end of the change.
bool is_over(const Line& line, const OffsetChange& change, double s_m);

// Largest second derivative of a change of length one and height one; at u = 0.21 and, with the
// opposite sign, at u = 0.79.
inline constexpr double kLargestBend = 5.7735026918962573;  // 10 / sqrt(3)

// Position beside a point of the line, with direction and curvature of the path there.
struct Beside {
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset, curvature_per_m = kUnset;
};
Beside beside(const LinePoint& point, const Offset& offset);
double curvature_beside(double line_curvature_per_m, const Offset& offset);

}  // namespace pitwall::planning
