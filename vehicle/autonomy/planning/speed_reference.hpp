// Speed reference: a speed that moves to a target with limited acceleration and jerk.
//   invariants
//          demanded acceleration, relative to a target that moves, = +-sqrt(2 j |target - v|)
//          within its limits, approached at rate j: it reaches the target with the acceleration of
//          the target and without overshoot
//   cost   O(1)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/vocabulary/units.hpp"

namespace pitwall::planning {

struct SpeedReference {
  double speed_mps = 0.0, accel_mps2 = 0.0;
};

struct SpeedLimits {
  double target_mps = 0.0;
  double accel_max_mps2 = 0.0, decel_max_mps2 = 0.0;  // -accel_max <= decel_max
  double jerk_max_mps3 = 1.0;
  double target_accel_mps2 = 0.0;  // by which the target moves
};

// Acceleration that lands on the target, without regard to the limits.
double landing_mps2(double speed_mps, const SpeedLimits& limits, double dt_s);

SpeedReference advance(const SpeedReference& reference, const SpeedLimits& limits, double dt_s);

}  // namespace pitwall::planning
