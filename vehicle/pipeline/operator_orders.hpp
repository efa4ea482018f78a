// Orders of the operator that hold: the commands of the radio beside the switches at the car, as
// one set of requests for this tick, and what became of each command.
//   in     commands of this tick, switches, the mode before and after the supervisor
//   out    requests, speed limit and track flag that hold; answers
//   invariants
//          "applied" is said when the car did it: an arm command that finds a fault in the way is
//          refused and does not lie in wait; nothing is applied after its expiry
//          of two flags the one that allows less holds, of two speed limits the lower
//          arming by command is an act of its own, as a switch that is released and closed again;
//          a switch that is closed afterwards has the last word again
//          what leaves the car without any position or without any sense of its motion is not
//          excluded while it moves; a stop is acknowledged only where the car stands
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
#include "vehicle/world/sensor_use.hpp"

namespace pitwall::pipeline {

using Answers = FixedVector<world::AnsweredCommand, 2 * world::kOperatorCommandsMax>;

struct OperatorOrders {
  std::optional<bool> arm;  // unset: the switch decides
  bool switch_was = false;
  std::optional<world::OperatorCommand> arming, reset;  // to be answered when the car has decided
  std::optional<bool> arm_before;                       // what `arm` was before `arming`
  bool close_next = false;                              // `arming` is let go now, given next tick
  double speed_limit_mps = kUnset;
  world::SensorUse use;                             // until another set is ordered
  world::TrackFlag flag = world::TrackFlag::kNone;  // kNone: no opinion
};
static_assert(std::is_trivially_copyable_v<OperatorOrders>);

struct OrderInputs {
  safety::OperatorRequests switches;
  const world::OperatorInputs& operator_inputs;
  std::span<const world::OperatorCommand> commands;
  bool may_arm = true;
  world::Mode mode = world::Mode::kDisarmed;  // before this tick
  bool stands = true;                         // likewise
  Instant now{};
};

// Before the supervisor: what it shall hear.
safety::OperatorRequests execute(OperatorOrders& orders, const OrderInputs& inputs,
                                 Answers& answers);

// After it: what it made of that. `resettable`: there was something that a reset ends, besides
// Mode::kHalted.
void conclude(OperatorOrders& orders, world::Mode before, const safety::SupervisorOutput& chosen,
              bool resettable, Instant now, Answers& answers);

// Whether what is left gives the car a position and a sense of its motion.
bool enough_to_drive(world::SensorUse use);
// NaN means none.
double lower_limit_mps(double a_mps, double b_mps);
// Race control as the car acts on it: the base's flag can only make it stricter.
world::RaceControl stricter(const world::RaceControl& received, world::TrackFlag of_base);

}  // namespace pitwall::pipeline
