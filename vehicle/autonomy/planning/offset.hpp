// A lateral offset from the line that changes once along it and is constant before and after: of
// all changes with neither slope nor bend at their ends the one with the least jerk.
//   invariants
//          n = from + (to - from) q(u), q = u^3 (10 - 15 u + 6 u^2), u in [0, 1] along the change
//   frames offset positive left; slope and bend are its derivatives along the line
//   cost   O(1)
//   source quintic of least jerk: Flash and Hogan, J. Neuroscience 5 (1985), eq. 12
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

// No length: it is `to` everywhere.
struct OffsetChange {
  double from_s_m = kUnset, length_m = 0.0;
  double from_m = 0.0, to_m = 0.0;
};

// Along a way that does not close.
Offset offset_at(const OffsetChange& change, double s_m);
// Along the line. A change is no longer than half a lap: what lies further behind than that counts
// as before it.
Offset offset_at(const Line& line, const OffsetChange& change, double s_m);
// Whether s lies behind the change.
bool is_over(const Line& line, const OffsetChange& change, double s_m);

// The largest second derivative of a change, where its length is one and its height is one; it lies
// at u = 0.21 and, with the other sign, at u = 0.79.
inline constexpr double kLargestBend = 5.7735026918962573;  // 10 / sqrt(3)

// The place beside a point of the line, and the direction and the curvature of the path there.
struct Beside {
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset, curvature_per_m = kUnset;
};
Beside beside(const LinePoint& point, const Offset& offset);
double curvature_beside(double line_curvature_per_m, const Offset& offset);

}  // namespace pitwall::planning
