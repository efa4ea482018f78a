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

#include <array>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/control/longitudinal.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::control {

struct StopSpeedParams {
  double kpa_per_mps2 = kUnset;  // pressure for 1 m/s^2
  double coast_mps2 = kUnset;    // rolling and engine, throttle closed
  double drag_per_m = kUnset;
  double speed_share_per_s = kUnset;
  double preview_s = kUnset;  // what the brakes take
  double throttle_fall_per_s = kUnset;
  double brake_rate_kpa_per_s = kUnset;  // up and down
  double hold_rate_kpa_per_s = kUnset;   // at standstill
};

inline constexpr auto kStopSpeedRanges = std::to_array<world::NamedRange<StopSpeedParams>>({
    {"kpa_per_mps2", &StopSpeedParams::kpa_per_mps2, 50.0, 1000.0},
    {"coast_mps2", &StopSpeedParams::coast_mps2, 0.0, 3.0},
    {"drag_per_m", &StopSpeedParams::drag_per_m, 0.0, 0.01},
    {"speed_share_per_s", &StopSpeedParams::speed_share_per_s, 0.0, 3.0},
    {"preview_s", &StopSpeedParams::preview_s, 0.0, 0.5},
    {"throttle_fall_per_s", &StopSpeedParams::throttle_fall_per_s, 0.2, 20.0},
    {"brake_rate_kpa_per_s", &StopSpeedParams::brake_rate_kpa_per_s, 500.0, 20000.0},
    {"hold_rate_kpa_per_s", &StopSpeedParams::hold_rate_kpa_per_s, 100.0, 20000.0},
});

struct StopTarget {
  double speed_mps = kUnset;   // at the car
  double accel_mps2 = kUnset;  // a moment ahead
};

// brake_max, hold speed and hold pressure are those of longitudinal.
LongitudinalOutput slow(const StopSpeedParams& params, const LongitudinalParams& longitudinal,
                        const LongitudinalState& state, const StopTarget& target, double speed_mps,
                        Duration dt);

}  // namespace pitwall::control
