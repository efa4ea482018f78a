// Longitudinal controller: proportional plus feed-forward on the target speed. One signed command
// is split into throttle and scaled brake pressure, each with its own rate limits. At standstill
// with target speed zero a holding pressure is applied.
//   invariants
//          c = kp (v* - v) + k_ff v*;  c >= 0: throttle c;  c < 0: brake -c * brake_kpa_per_command
//   source Saba et al., Fast and Modular Autonomy Software, sec. controls
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::control {

struct LongitudinalParams {
  double kp_per_mps = kUnset;           // throttle fraction per m/s
  double feedforward_per_mps = kUnset;  // throttle fraction per m/s
  double brake_kpa_per_command = kUnset;
  double speed_preview_s = kUnset;  // look-ahead of the target speed
  double throttle_max = kUnset;
  double throttle_rise_per_s = kUnset;
  double throttle_fall_per_s = kUnset;
  double brake_max_kpa = kUnset;
  double brake_rise_kpa_per_s = kUnset;
  double brake_fall_kpa_per_s = kUnset;
  double hold_speed_mps = kUnset;  // below it, with target zero, the car is held
  double hold_brake_kpa = kUnset;
};

inline constexpr auto kLongitudinalRanges = std::to_array<world::NamedRange<LongitudinalParams>>({
    {"kp_per_mps", &LongitudinalParams::kp_per_mps, 0.01, 2.0},
    {"feedforward_per_mps", &LongitudinalParams::feedforward_per_mps, 0.0, 0.05},
    {"brake_kpa_per_command", &LongitudinalParams::brake_kpa_per_command, 100.0, 20000.0},
    {"speed_preview_s", &LongitudinalParams::speed_preview_s, 0.0, 1.0},
    {"throttle_max", &LongitudinalParams::throttle_max, 0.0, 1.0},
    {"throttle_rise_per_s", &LongitudinalParams::throttle_rise_per_s, 0.1, 20.0},
    {"throttle_fall_per_s", &LongitudinalParams::throttle_fall_per_s, 0.1, 100.0},
    {"brake_max_kpa", &LongitudinalParams::brake_max_kpa, 500.0, 9000.0},
    {"brake_rise_kpa_per_s", &LongitudinalParams::brake_rise_kpa_per_s, 500.0, 50000.0},
    {"brake_fall_kpa_per_s", &LongitudinalParams::brake_fall_kpa_per_s, 500.0, 50000.0},
    {"hold_speed_mps", &LongitudinalParams::hold_speed_mps, 0.1, 2.0},
    {"hold_brake_kpa", &LongitudinalParams::hold_brake_kpa, 100.0, 3000.0},
});

struct LongitudinalState {
  double throttle_fraction = 0.0, brake_kpa = 0.0;  // last command
};

struct LongitudinalOutput {
  double target_speed_mps = kUnset;
  double raw_command = kUnset;  // c, before limits
  LongitudinalState next;       // also this tick's command
};

// Throttle and brake are released at their rates if the target or the speed is not finite.
LongitudinalOutput step(const LongitudinalParams& params, const LongitudinalState& state,
                        double target_speed_mps, double speed_mps, Duration dt);

}  // namespace pitwall::control
