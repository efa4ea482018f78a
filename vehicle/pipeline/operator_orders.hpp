// Operator commands with lasting effect: combines the commands of the radio with the switches at
// the car into the requests of this tick, and answers each command.
//   in     commands of this tick, switches, the mode before and after the supervisor
//   out    requests, speed limit and track flag in effect; answers
//   invariants
//          "applied" is answered after the car did it: an arm command that a fault bars is refused
//          and does not wait; nothing is applied after its expiry
//          the more restrictive of two flags and the lower of two speed limits are in effect
//          an arm command acts like a switch that is opened and closed again; a switch that is
//          closed afterwards takes precedence again
//          an exclusion that leaves the car without a position or without a motion sensor is
//          refused while the car moves; a stop is acknowledged only at standstill
//   units  m/s
//   cost   no allocation; O(commands)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/safety/fault_detection.hpp"
#include "vehicle/safety/supervisor.hpp"
#include "vehicle/world/mode.hpp"
#include "vehicle/world/operator_inputs.hpp"
#include "vehicle/world/race_control.hpp"

namespace pitwall::pipeline {

using Answers = FixedVector<world::AnsweredCommand, 2 * world::kOperatorCommandsMax>;

struct OperatorOrders {
  std::optional<bool> arm;  // unset: the switch decides
  bool switch_was = false;
  std::optional<world::OperatorCommand> arming,
      reset;                       // answered by conclude()
  std::optional<bool> arm_before;  // value of `arm` before `arming`
  bool close_next = false;         // the request is withdrawn in this tick, set in the next
  double speed_limit_mps = kUnset;
  double fuel_entered_l = kUnset;                   // in this tick
  world::SensorUse use;                             // until another set is commanded
  world::TrackFlag flag = world::TrackFlag::kNone;  // kNone: no flag from the base
};
static_assert(std::is_trivially_copyable_v<OperatorOrders>);

struct OrderInputs {
  safety::OperatorRequests switches;
  const world::OperatorInputs& operator_inputs;
  std::span<const world::OperatorCommand> commands;
  bool may_arm = true;
  world::Mode mode = world::Mode::kDisarmed;  // before this tick
  bool stands = true;                         // before this tick
  Instant now{};
};

// To be called before the supervisor: applies the commands and returns the requests for it.
safety::OperatorRequests execute(OperatorOrders& orders, const OrderInputs& inputs,
                                 Answers& answers);

// To be called after the supervisor: answers the pending commands. `resettable`: there was
// something besides Mode::kHalted that a reset ends.
void conclude(OperatorOrders& orders, world::Mode before, const safety::SupervisorOutput& chosen,
              bool resettable, Instant now, Answers& answers);

// Whether the remaining sensors give a position and a motion measurement.
bool enough_to_drive(world::SensorUse use);
// Race control as the car acts on it: the flag of the base can only make it more restrictive, and
// no round speed lets the car drive faster than its file.
world::RaceControl acted_on(const world::RaceControl& received, world::TrackFlag of_base,
                            double speed_max_mps);

}  // namespace pitwall::pipeline
