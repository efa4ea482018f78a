// Longitudinal law with feed-forward: the planned acceleration plus a PI on the speed error,
// limited to what the tyres have left, as throttle and brake pressure (drivetrain.hpp).
//   in     reference speed and planned acceleration, the motion of the car and its gear, what was
//          applied in the last tick
//   out    throttle and brake pressure
//   invariants
//          wanted = planned + clamp(kp e + integral), within the tyres' limits beside the present
//          lateral acceleration (yaw rate and bank), by the temperature of the tyres
//          the integral stands still while throttle or brake cannot follow it (at a limit, at a
//          rate, in a shift, changed by another module) and is empty while control does not drive
//          throttle and brake continue from what was applied, at their rates, and one of them is
//          zero: neither rises before the other is gone
//          a shift holds the throttle: the engine's computer cuts and blips by itself
//   errors throttle and brake are released at their rates if reference or speed is not finite
//   cost   O(rows of the engine), no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/control/drivetrain.hpp"
#include "vehicle/autonomy/control/longitudinal.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::control {

struct SpeedLawParams {
  double accel_preview_s = kUnset;  // of the planned acceleration: the lag of engine and brake
  double kp_per_s = kUnset, ki_per_s2 = kUnset;
  double feedback_max_mps2 = kUnset, integral_max_mps2 = kUnset;
  double rolling_mps2 = kUnset, dead_zone_mps2 = kUnset;  // of DrivetrainParams
  double grip_share = kUnset;                             // of the tyres' limit
  // Written elsewhere in the car file.
  envelope::FrictionParams car;
  double brake_kpa_per_mps2 = kUnset;
};

inline constexpr auto kSpeedLawRanges = std::to_array<world::NamedRange<SpeedLawParams>>({
    {"accel_preview_s", &SpeedLawParams::accel_preview_s, 0.0, 0.5},
    {"kp_per_s", &SpeedLawParams::kp_per_s, 0.1, 5.0},
    {"ki_per_s2", &SpeedLawParams::ki_per_s2, 0.0, 5.0},
    {"feedback_max_mps2", &SpeedLawParams::feedback_max_mps2, 0.5, 10.0},
    {"integral_max_mps2", &SpeedLawParams::integral_max_mps2, 0.0, 5.0},
    {"rolling_mps2", &SpeedLawParams::rolling_mps2, 0.0, 1.0},
    {"dead_zone_mps2", &SpeedLawParams::dead_zone_mps2, 0.0, 2.0},
    {"grip_share", &SpeedLawParams::grip_share, 0.1, 1.0},
});

struct SpeedLawState {
  double integral_mps2 = 0.0;
  bool braking = false;
};

struct SpeedInputs {
  double reference_mps = kUnset, planned_mps2 = kUnset;
  Motion motion;
  double yaw_rate_rad_per_s = 0.0, bank_rad = 0.0;
  double tyre_c = kUnset;     // unset counts as cold
  bool shifting = false;      // the gearbox transmits nothing
  bool drives = true;         // what comes out is sent to the car
  LongitudinalState applied;  // in the last tick
  bool changed = false;       // by another module: it is not what came out
};

struct SpeedDiagnostics {
  double wanted_mps2 = kUnset;  // after the limits
  double integral_mps2 = kUnset;
  bool grip_limited = false;  // the tyres have less left than was wanted
  bool saturated = false;     // throttle or brake does not give what is wanted
};

struct SpeedOutput {
  LongitudinalState next;  // also this tick's command
  SpeedDiagnostics seen;
};

SpeedOutput step(const SpeedLawParams& params, const LongitudinalParams& limits,
                 SpeedLawState& state, const SpeedInputs& inputs, Duration dt);

}  // namespace pitwall::control
