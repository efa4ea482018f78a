// What the frame gate lets the wheels do, and the speed at which a car can still turn with it: one
// table, known to planning, control and the stop. The gate has its own reading of the frames.
//   in     the largest angle by speed; the car's bicycle with what was learned; a road
//   out    the angle at a speed, linear between the rows and constant outside; the fastest speed at
//          which the steady-state angle of the road stays within a share of it
//   invariants
//          speeds of the rows rise, angles do not
//          L k + K (v^2 k - g sin(bank)) + d' <= share * angle_max(v),  k = |kappa| cos(bank)
//   errors none: a road that no speed can follow has the speed zero
//   cost   O(rows), no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "vehicle/steering/learned_steering.hpp"

namespace pitwall::steering {

struct AngleRow {
  double speed_mps = kUnset, angle_rad = kUnset;
};
inline constexpr std::size_t kAngleRows = 10;
using AngleLimits = std::array<AngleRow, kAngleRows>;

double angle_max_rad(const AngleLimits& limits, double speed_mps);

struct AngleBudget {
  const AngleLimits& limits;
  double wheelbase_m = kUnset, understeer_rad_per_mps2 = kUnset, offset_rad = 0.0;
  double share = 1.0;
};

// At most that of the last row.
double fastest_mps(const AngleBudget& budget, double curvature_per_m, double bank_rad);

}  // namespace pitwall::steering
