// Selection of the actuator command of a tick: the part of the supervisor that follows its mode
// decision.
//   in     the mode, control's command while the car drives, the stop trajectory, the joystick
//          inputs
//   out    a command and its source; then with the joystick's throttle cap and brake, and slew
//          limits
//   invariants
//          a change of source causes no jump; in a stop the throttle never rises; while coasting it
//          is zero; it is zero while the brake is above kBrakeTouched_kpa
//          while the car drives or coasts, over-steer releases the brake, and front wheels that
//          lock take pressure back by the law of stop_brake.hpp until the brake is released
//          in a controlled stop the brake stays within the grip of the tyres at the speed; in a
//          stop and while coasting the steering stays within the limit of the frame gate
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
  WheelSlip slip{};
};

struct ChosenCommand {
  world::ActuatorCommand command;
  CommandSource source = CommandSource::kNone;
};

ChosenCommand choose(const Tick& t);
world::ActuatorCommand shape(const Tick& t, const world::ActuatorCommand& chosen);

bool is_usable(const world::ActuatorCommand& command);
bool is_located(const world::EgoState& ego);

}  // namespace pitwall::safety
