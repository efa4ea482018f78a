// Whose command goes to the actuators in a tick, and in which shape: the part of the supervisor
// that comes after its decision.
//   in     the mode that was decided, control's command while the car drives, the last stop, the
//          joystick's word
//   out    a command and its source; then slowed by the joystick and within the slews
//   invariants
//          a change of source is no jump; in a stop the throttle never rises; coasting has none;
//          with the brake touched the throttle yields; in a controlled stop the brake stays within
//          the grip of the tyres at the speed, in every stop the steering within the gate's limit
//   errors none
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/vocabulary/time.hpp"
#include "vehicle/safety/supervisor.hpp"
#include "vehicle/world/actuator_command.hpp"
#include "vehicle/world/ego_state.hpp"

namespace pitwall::safety {

struct Tick {
  const SupervisorParams& params;
  SupervisorState& state;
  const SupervisorInputs& in;
  Instant now;
  double speed_mps;
};

struct Chosen {
  world::ActuatorCommand command;
  CommandSource source = CommandSource::kNone;
};

Chosen choose(const Tick& t);
world::ActuatorCommand shape(const Tick& t, const world::ActuatorCommand& chosen);

bool is_usable(const world::ActuatorCommand& command);
bool is_located(const world::EgoState& ego);

}  // namespace pitwall::safety
