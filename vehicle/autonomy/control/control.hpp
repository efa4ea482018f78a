// Vehicle controller: drive trajectory in, actuator command out. The car file selects one of two
// lateral control laws: the published regulator (lateral.hpp) or the one with feed-forward
// (feed_forward.hpp). A stop does not use this module.
//   in     EgoState and Trajectory (Map, Body); the learned correction of the steering
//   out    ActuatorCommand, diagnostics, next state
//   rate   100 Hz
//   errors LateralDiagnostics.verdict. Without a trajectory or an ego state the angle is held, and
//          throttle and brake are released at their rates: vehicle/safety decides whether to stop
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
  steering::Params steering;  // for kFeedForward
  LongitudinalParams longitudinal;
  GearParams gear;
};

struct State {
  double road_wheel_rad = 0.0;  // last command
  LongitudinalState longitudinal;
  GearState gear;
  steering::State steering;
};

struct Inputs {
  const world::EgoState& ego;
  const world::Trajectory& trajectory;
  steering::Learned learned{};
  double angle_max_rad = kUnset;  // limit of the frame gate at this speed; unset: none
};

struct Output {
  world::ActuatorCommand command;
  LateralDiagnostics lateral;
  double target_speed_mps = kUnset;
  State next;
};

// At start-up: checks every parameter against its legal range; the place of a Problem is the name
// of the parameter.
Result<LateralGains, Problem> prepare(const Params& params);

Output step(const Params& params, const LateralGains& gains, const State& state,
            const Inputs& inputs, Instant now, Duration dt);

}  // namespace pitwall::control
