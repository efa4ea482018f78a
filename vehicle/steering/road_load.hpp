// Lateral demand and normal load of a car on a banked road, per mass: one model for planning, the
// stops and the steering.
//   frames accelerations in the plane of the road, lateral positive left; curvature of the plan
//          view; bank positive where the left side is lower
//   invariants
//          the centripetal acceleration v^2 kappa is horizontal: its component cos(bank) lies in
//          the plane of the road, its component sin(bank) presses on the road
//            lateral demand  a = v^2 kappa cos(bank) - g sin(bank)
//            normal load     n = g cos(bank) + v^2 kappa sin(bank) + downforce v^2
//   errors none
//   source Rajamani, Vehicle Dynamics and Control, 2nd ed., sec. 2.4 (bank of the road)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::steering {

// Point of the road and a speed. For one point at many speeds a caller copies cos_bank and
// sin_bank.
struct RoadLoad {
  double speed_mps = kUnset, curvature_per_m = kUnset, bank_rad = kUnset;
  double cos_bank = std::cos(bank_rad), sin_bank = std::sin(bank_rad);
};

// Curvature in the plane of the road (yaw about the vertical axis of the body).
inline double turn_per_m(const RoadLoad& at) { return at.curvature_per_m * at.cos_bank; }

inline double lateral_demand_mps2(const RoadLoad& at) {
  return at.speed_mps * at.speed_mps * turn_per_m(at) - kGravity_mps2 * at.sin_bank;
}

inline double normal_load_mps2(const RoadLoad& at, double downforce_per_m) {
  const double v2 = at.speed_mps * at.speed_mps;
  return kGravity_mps2 * at.cos_bank + v2 * at.curvature_per_m * at.sin_bank + downforce_per_m * v2;
}

}  // namespace pitwall::steering
