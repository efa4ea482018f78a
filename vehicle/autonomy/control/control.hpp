// Vehicle control: drive trajectory in, actuator command out, by the controller of the car file
// (controller.hpp) and the gear selection. A stop does not use this module.
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
#include "vehicle/autonomy/control/controller.hpp"
#include "vehicle/world/actuator_command.hpp"

namespace pitwall::control {

struct Output {
  world::ActuatorCommand command;
  LateralDiagnostics lateral;
  SpeedDiagnostics speed;
  double target_speed_mps = kUnset;
  State next;
};

// At start-up: checks every parameter against its legal range; the place of a Problem is the name
// of the parameter.
Result<LateralGains, Problem> prepare(const Params& params);

Output step(const Params& params, const LateralGains& gains, const State& state,
            const Inputs& inputs, Instant now, Duration dt);

}  // namespace pitwall::control
