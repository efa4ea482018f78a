// Longitudinal controller: proportional plus feed-forward on the target speed, one signed command
// split into throttle or scaled brake pressure, each smoothed by its own rate limits. At standstill
// with target zero a holding pressure is applied.
//   invariants
//          c = kp (v* - v) + k_ff v*;  c >= 0: throttle c;  c < 0: brake -c * brake_kpa_per_command
//   source Saba et al., Fast and Modular Autonomy Software, sec. controls
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::control {

struct LongitudinalParams {
  double kp_per_mps = kUnset;             // 0.01..2: throttle fraction per m/s
  double feedforward_per_mps = kUnset;    // 0..0.05: throttle fraction per m/s
  double brake_kpa_per_command = kUnset;  // 100..20000
  double speed_preview_s = kUnset;        // 0..1: the target is read this far ahead
  double throttle_max = kUnset;           // 0..1
  double throttle_rise_per_s = kUnset;    // 0.1..20
  double throttle_fall_per_s = kUnset;    // 0.1..100
  double brake_max_kpa = kUnset;          // 500..9000
  double brake_rise_kpa_per_s = kUnset;   // 500..50000
  double brake_fall_kpa_per_s = kUnset;   // 500..50000
  double hold_speed_mps = kUnset;         // 0.1..2: below it, with target zero, hold the car
  double hold_brake_kpa = kUnset;         // 100..3000
};

struct LongitudinalState {
  double throttle_fraction = 0.0, brake_kpa = 0.0;  // as last commanded
};

struct LongitudinalOutput {
  double target_speed_mps = kUnset;
  double raw_command = kUnset;  // c, before limits
  LongitudinalState next;       // also the command
};

// A target or a speed that is not finite lets go of the throttle and the brake at their rates.
LongitudinalOutput step(const LongitudinalParams& params, const LongitudinalState& state,
                        double target_speed_mps, double speed_mps, Duration dt);

}  // namespace pitwall::control
