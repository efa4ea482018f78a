// The controller of the car: drive trajectory in, actuator command out. One of two laws steers, by
// the car's file: the published regulator (lateral.hpp) or the one with feed-forward
// (feed_forward.hpp). Not asked during a stop.
//   in     EgoState and Trajectory (Map, Body); what was learned of the car's steering
//   out    ActuatorCommand, diagnostics, next state
//   rate   100 Hz
//   errors LateralDiagnostics.verdict; a missing trajectory or ego holds the angle and lets go of
//          throttle and brake at their rates: stopping is the decision of vehicle/safety
//   cost   O(trajectory points), no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/control/bicycle_params.hpp"
#include "vehicle/autonomy/control/gear.hpp"
#include "vehicle/autonomy/control/lateral.hpp"
#include "vehicle/autonomy/control/longitudinal.hpp"
#include "vehicle/steering/path_steering.hpp"
#include "vehicle/world/actuator_command.hpp"
#include "vehicle/world/ego_state.hpp"
#include "vehicle/world/trajectory.hpp"

namespace pitwall::control {

enum class LateralLaw : std::uint8_t { kPaperLqr, kFeedForward };

struct Params {
  BicycleParams bicycle;
  LateralParams lateral;
  LateralLaw drive_law = LateralLaw::kPaperLqr;
  steering::Params steering;  // of the law with feed-forward
  LongitudinalParams longitudinal;
  GearParams gear;
};

struct State {
  double road_wheel_rad = 0.0;  // as last commanded
  LongitudinalState longitudinal;
  GearState gear;
  steering::State steering;
};

struct Inputs {
  const world::EgoState& ego;
  const world::Trajectory& trajectory;
  steering::Learned learned{};
  double angle_max_rad = kUnset;  // what the frame gate lets pass at this speed; unset: all
};

struct Output {
  world::ActuatorCommand command;
  LateralDiagnostics lateral;
  double target_speed_mps = kUnset;
  State next;
};

// Start-up: checks every parameter against its legal range; the place is the parameter's name.
Result<LateralGains, Problem> prepare(const Params& params);

Output step(const Params& params, const LateralGains& gains, const State& state,
            const Inputs& inputs, Instant now, Duration dt);

}  // namespace pitwall::control
