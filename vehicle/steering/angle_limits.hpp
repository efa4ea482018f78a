// Steering angle limit by speed, and the highest speed at which a car can follow a curve within it.
// Planning, control and the stop share this table; the frame gate has its own.
//   in     the largest angle by speed; the car's bicycle model with the learned correction; a road
//   out    the angle at a speed, linear between the rows and constant outside; the highest speed at
//          which the steady-state angle for the road stays within a share of it
//   invariants
//          speeds of the rows rise, angles do not rise
//          with the doubt D of learned_steering.hpp, k and a of road_load.hpp, as for a left turn,
//            L k + K a + d' + D(a) <= share * angle_max(v)
//            D(a) v^2 <= stray: the uncertainty costs at most a distance from the line
//   errors none: for a road that no speed can follow the result is zero
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
  const Bicycle& car;
  const LearningParams& learning;
  const Learned& learned;
  double share = 1.0;
  double stray_m_rad_per_s2 = kUnset;  // stray_m_rad_per_s2() of path_steering.hpp
};

// Highest speed for a curve, at most most_mps.
double fastest_mps(const AngleBudget& budget, double curvature_per_m, double bank_rad,
                   double most_mps);

}  // namespace pitwall::steering
