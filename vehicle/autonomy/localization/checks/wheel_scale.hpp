// Scale of the wheel speeds against the car's speed: a tyre grows with the square of its speed, so
// that its wheel reads low; the rest (pressure, wear, steady slip) is learned while receivers give
// the speed, and held while they do not.
//
//     true = reported (1 + growth (v^2 - v0^2) + learned)
//
//   in     the wheels' speed as reported, the car's by receivers, how it accelerates
//   out    the speed without the scale's error, and the share of it that is one sigma
//   invariants
//          nothing is learned from wheels that may slip: below kLeastSpeed_mps, or beyond
//          kMostAccel_mps2. What is learned is within +-kMost
//   source growth: 3.8e-6 (s/m)^2, fitted to a recorded AV-21 drive (hil/sensors/README.md)
//   cost   O(1)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

#include "vehicle/autonomy/localization/checks/check_params.hpp"

namespace pitwall::localization {

struct WheelScale {
  static constexpr double kLeastSpeed_mps = 10.0, kMostAccel_mps2 = 4.0;
  static constexpr double kMost = 0.05;

  double learned = 0.0;  // beside the growth
  double known_s = 0.0;  // how long it has been learned
};
static_assert(std::is_trivially_copyable_v<WheelScale>);

double without_scale(const CheckParams& params, const WheelScale& scale, double reported_mps);

// One sigma of what is left, as a share of the speed; `unknown` before anything was learned.
double scale_sigma(const CheckParams& params, const WheelScale& scale, double unknown);

// One report, `since_s` after the one before.
void learn(const CheckParams& params, WheelScale& scale, double reported_mps,
           double by_receivers_mps, double accel_mps2, double since_s);

}  // namespace pitwall::localization
