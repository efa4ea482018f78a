// Throttle and brake along a stop: the pressure that the planned deceleration needs beside air,
// rolling and engine, corrected by the error of the speed. The throttle is let go, never opened.
//   in     planned speed and acceleration at the car and a moment ahead, the car's speed
//   out    throttle fraction, brake pressure, each within its own rates: no step of acceleration
//   invariants
//          decel = -a* + share (v - v*), pressure = (decel - coast - drag v^2) * kpa_per_mps2, in
//          [0, brake_max]. Standing with nothing planned: the holding pressure, slowly
//   errors a target or a speed that is not finite lets go of both at their rates
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/control/longitudinal.hpp"

namespace pitwall::control {

struct StopSpeedParams {
  double kpa_per_mps2 = kUnset;          // 50..1000: pressure for 1 m/s^2
  double coast_mps2 = kUnset;            // 0..3: rolling and engine, throttle closed
  double drag_per_m = kUnset;            // 0..0.01
  double speed_share_per_s = kUnset;     // 0..3
  double preview_s = kUnset;             // 0..0.5: what the brakes take
  double throttle_fall_per_s = kUnset;   // 0.2..20
  double brake_rate_kpa_per_s = kUnset;  // 500..20000: up and down
  double hold_rate_kpa_per_s = kUnset;   // 100..20000: at standstill
};

struct StopTarget {
  double speed_mps = kUnset;   // at the car
  double accel_mps2 = kUnset;  // a moment ahead
};

// brake_max, hold speed and hold pressure are those of longitudinal.
LongitudinalOutput slow(const StopSpeedParams& params, const LongitudinalParams& longitudinal,
                        const LongitudinalState& state, const StopTarget& target, double speed_mps,
                        Duration dt);

}  // namespace pitwall::control
