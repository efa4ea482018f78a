// Lateral regulator with feed-forward: the control law of steering/path_steering.hpp along the
// drive trajectory.
//   in     EgoState (Map, Body), Trajectory (Map), the learned correction of the steering
//   out    road-wheel angle [rad], left positive
//   errors verdict as in lateral.hpp; without a usable trajectory or ego state the last angle is
//          held
//   cost   O(trajectory points), no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/control/lateral.hpp"
#include "vehicle/steering/path_steering.hpp"

namespace pitwall::control {

// Where the car is on its path, for every law with feed-forward: the verdict and errors of the
// diagnostics, and the inputs of steering/path_steering.hpp.
struct OnPath {
  LateralDiagnostics diagnostics;
  steering::SteeringInputs in;
  double along_m = kUnset;  // station on the trajectory

  bool is_usable() const {
    return diagnostics.verdict == LateralVerdict::kGood ||
           diagnostics.verdict == LateralVerdict::kTooFar;
  }
};

// The angle limits are those of `lateral` and `angles`.
OnPath on_path(const steering::Params& params, const LateralParams& lateral,
               const steering::Learned& learned, const Angles& angles, const world::EgoState& ego,
               const world::Trajectory& trajectory);

// The diagnostics with the angle of a law.
LateralDiagnostics steered(const OnPath& path, double angle_rad);

LateralDiagnostics steer_forward(const steering::Params& params, const LateralParams& lateral,
                                 const steering::Learned& learned, steering::State& state,
                                 const Angles& angles, const world::EgoState& ego,
                                 const world::Trajectory& trajectory, Duration dt);

}  // namespace pitwall::control
