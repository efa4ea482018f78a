// Steering along a stop: feed-forward of curvature and banking, feedback of the distance and the
// course, and an observer of what the steering model does not know. The published regulator of
// lateral.hpp has none of these and stands 0.5 to 1.5 m beside its path in a banked turn.
//   in     EgoState (Map, Body), Trajectory (Map)     out  road-wheel angle [rad], left positive
//   invariants
//          angle = L k + K a_y + (L + K v^2) k_fb + d + trim + bumpless, with, of the path a moment
//          ahead, k = kappa cos(bank), a_y = v^2 k - g sin(bank), and
//            K    = m lr / (Cf L) - m lf / (Cr L)
//            k_fb = -(w^2 e + 2 z w v chi) / v^2: both poles of e' = v chi, chi' = v k at w, with
//                   damping z; e to the left of the path, chi the course against it
//            d    = low pass of (angle commanded a moment ago) - (L r / v + K (v r - g sin(bank))):
//                   what this car on these tyres needs beyond the model, seen by its yaw rate r
//            trim = -trim_per_s * (L + K v^2) w^2 / v^2 * integral of e
//          bumpless is what makes the first angle the last one of whoever steered before; it decays
//          over settle_s. Below hold_speed_mps the wheels stay
//   errors verdict as in lateral.hpp; without a usable trajectory or ego the last angle is held
//   cost   O(trajectory points), no allocation
//   source Rajamani, Vehicle Dynamics and Control, 2nd ed., eq. 3.12 (feed-forward), with the
//          gravity of the bank; Chen et al., Disturbance-Observer-Based Control, 2016 (observer)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/control/bicycle_params.hpp"
#include "vehicle/autonomy/control/lateral.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::control {

struct StopSteeringParams {
  double bandwidth_rad_per_s = kUnset;  // w
  double damping = kUnset;              // z
  double preview_s = kUnset;            // what the steering takes
  double observer_s = kUnset;           // low pass of d
  double trim_per_s = kUnset;
  double settle_s = kUnset;
  double correction_max_rad = kUnset;    // of d and of trim, each
  double gain_speed_least_mps = kUnset;  // the feedback is no steeper below
  double hold_speed_mps = kUnset;
};

inline constexpr auto kStopSteeringRanges = std::to_array<world::NamedRange<StopSteeringParams>>({
    {"bandwidth_rad_per_s", &StopSteeringParams::bandwidth_rad_per_s, 0.5, 6.0},
    {"damping", &StopSteeringParams::damping, 0.5, 1.5},
    {"preview_s", &StopSteeringParams::preview_s, 0.0, 0.5},
    {"observer_s", &StopSteeringParams::observer_s, 0.05, 5.0},
    {"trim_per_s", &StopSteeringParams::trim_per_s, 0.0, 2.0},
    {"settle_s", &StopSteeringParams::settle_s, 0.1, 5.0},
    {"correction_max_rad", &StopSteeringParams::correction_max_rad, 0.0, 0.1},
    {"gain_speed_least_mps", &StopSteeringParams::gain_speed_least_mps, 2.0, 20.0},
    {"hold_speed_mps", &StopSteeringParams::hold_speed_mps, 0.1, 5.0},
});

struct StopSteering {
  bool active = false;
  double commanded_rad = 0.0;  // low pass of the commands: what the wheels have done by now
  double unknown_rad = 0.0;    // d
  double trim_rad = 0.0, bump_rad = 0.0;
};

// The understeer gradient K of the model.
double understeer_rad_per_mps2(const BicycleParams& car);

// In every tick, whoever steers: learns d from the last command and the yaw rate.
void observe(const StopSteeringParams& params, const BicycleParams& car, StopSteering& state,
             double last_angle_rad, const world::EgoState& ego, double bank_rad, Duration dt);

// angle_max_rad and deviation_max_m are those of lateral.
LateralDiagnostics steer_stop(const StopSteeringParams& params, const LateralParams& lateral,
                              const BicycleParams& car, StopSteering& state, double last_angle_rad,
                              const world::EgoState& ego, const world::Trajectory& trajectory,
                              Duration dt);

}  // namespace pitwall::control
