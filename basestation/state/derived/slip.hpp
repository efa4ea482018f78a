// Slip of the driven wheels relative to the speed of the car. Before the spin in the paper, the
// rear wheels were faster than the front ones, and these faster than GPS.
//   in     speeds of the wheels and of the receivers [m/s]; unset if unknown or stale
//   out    rear - front and rear - GNSS as shares of front and GNSS speed; unset if one is missing
//   invariants
//          the speed of an axle is the mean of left and right, so that a corner has no effect.
//          Below kSlipSpeed_mps the share is 0, because sensor errors are larger than the slip
//   source Saba et al.: the spin, wheel speeds of the second before it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/vocabulary/units.hpp"

namespace pitwall::state {

inline constexpr double kSlipSpeed_mps = 20.0;

struct WheelSpeeds {
  double front_left_mps = kUnset, front_right_mps = kUnset;
  double rear_left_mps = kUnset, rear_right_mps = kUnset;
};
struct Slip {
  double rear_front = kUnset, rear_gnss = kUnset;

  double worst() const;  // unset if both are
};
Slip slip_of(const WheelSpeeds& wheels, double gnss_mps);

}  // namespace pitwall::state
