// Scale factor of the wheel speeds. A tyre grows with the square of its speed, so that its wheel
// reads low; the remaining error (pressure, wear, steady slip) is learned while receivers give the
// speed, and held otherwise.
//
//     true = reported (1 + growth (v^2 - v0^2) + learned)
//
//   in     the wheels' speed as reported, the speed from the receivers, the longitudinal
//          acceleration
//   out    the speed without the scale error; the remaining error (one sigma) as a share of the
//          speed
//   invariants
//          nothing is learned from wheels that may slip: below kLeastSpeed_mps, or beyond
//          kMostAccel_mps2. The learned part stays within +-kMost
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

  double learned = 0.0;  // in addition to the growth
  double known_s = 0.0;  // learning time so far
};
static_assert(std::is_trivially_copyable_v<WheelScale>);

double without_scale(const CheckParams& params, const WheelScale& scale, double reported_mps);

// Remaining error (one sigma) as a share of the speed; `unknown` before anything was learned.
double scale_sigma(const CheckParams& params, const WheelScale& scale, double unknown);

// Takes one report, `since_s` after the previous one.
void learn(const CheckParams& params, WheelScale& scale, double reported_mps,
           double by_receivers_mps, double accel_mps2, double since_s);

}  // namespace pitwall::localization
