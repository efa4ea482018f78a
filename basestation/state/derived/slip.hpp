// Slip of the driven wheels against the speed of the car. Before the paper's spin the rear wheels
// were faster than the front ones, and these faster than GPS.
//   in     speeds of the wheels and of the receivers [m/s]; unset where not known or stale
//   out    rear - front and rear - GNSS as shares of the latter; unset where one is missing
//   invariants
//          axles are compared by the mean of left and right, which a corner does not split; below
//          kSlipSpeed_mps the share is 0: at a crawl sensors differ more than wheels
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

  double worst() const;  // unset where both are
};
Slip slip_of(const WheelSpeeds& wheels, double gnss_mps);

}  // namespace pitwall::state
