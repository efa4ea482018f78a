// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/operator_orders.hpp"

#include <cmath>

namespace pitwall::pipeline {
namespace {

using world::CommandAnswer;
using world::Mode;
using world::OperatorCommand;
using world::OperatorCommandKind;
using world::StopRequest;
using world::TrackFlag;

constexpr double kYes = 1.0;

struct OrderHandler {
  OperatorOrders& orders;
  const OrderInputs& in;
  Answers& answers;

  void answer(const OperatorCommand& command, CommandAnswer answer) {
    // There are as many places as commands can come in a tick, and two that waited.
    (void)answers.push({command.id, answer, in.now});
  }
  void give_what_was_let_go();
  void arm(const OperatorCommand& command);
  void reset(const OperatorCommand& command);
  void exclude(const OperatorCommand& command);
  void take(const OperatorCommand& command);
};

void OrderHandler::give_what_was_let_go() {
  if (!orders.arming) return;
  orders.close_next = false;
  if (in.now <= orders.arming->expires) {
    orders.arm = true;
    return;
  }
  answer(*orders.arming, CommandAnswer::kExpired);
  orders.arm = orders.arm_before;
  orders.arming.reset();
}

void OrderHandler::arm(const OperatorCommand& command) {
  if (command.argument != kYes) {
    orders.arm = false;
    if (orders.arming) answer(*orders.arming, CommandAnswer::kRefused);
    orders.arming.reset();
    return answer(command, CommandAnswer::kApplied);
  }
  if (!in.may_arm || orders.arming) return answer(command, CommandAnswer::kRefused);
  if (in.mode != Mode::kDisarmed) {
    const bool is_armed =
        in.mode == Mode::kStandby || in.mode == Mode::kDriving || in.mode == Mode::kCoast;
    return answer(command, is_armed ? CommandAnswer::kApplied : CommandAnswer::kRefused);
  }
  orders.arm_before = orders.arm;
  orders.arm = false;
  orders.arming = command;
  orders.close_next = true;
}

void OrderHandler::reset(const OperatorCommand& command) {
  const bool now = in.stands || in.mode == Mode::kHalted;
  if (command.argument != kYes || orders.reset || !now)
    return answer(command, CommandAnswer::kRefused);
  orders.reset = command;
}

void OrderHandler::exclude(const OperatorCommand& command) {
  constexpr double kAll = (1U << world::kExcludables) - 1U;
  const bool is_set = command.argument >= 0.0 && command.argument <= kAll &&
                      command.argument == std::floor(command.argument);
  if (!is_set) return answer(command, CommandAnswer::kRefused);
  const world::SensorUse use{static_cast<std::uint16_t>(command.argument)};
  if (!in.stands && !enough_to_drive(use)) return answer(command, CommandAnswer::kRefused);
  orders.use = use;
  answer(command, CommandAnswer::kApplied);
}

void OrderHandler::take(const OperatorCommand& command) {
  if (in.now > command.expires) return answer(command, CommandAnswer::kExpired);
  switch (command.kind) {
    case OperatorCommandKind::kArm:
      return arm(command);
    case OperatorCommandKind::kReset:
      return reset(command);
    case OperatorCommandKind::kSpeedLimit:
      if (!(command.argument >= 0.0)) return answer(command, CommandAnswer::kRefused);
      orders.speed_limit_mps = command.argument;
      return answer(command, CommandAnswer::kApplied);
    case OperatorCommandKind::kTrackFlag: {
      const bool known =
          command.argument >= 0.0 && command.argument <= static_cast<double>(TrackFlag::kUnknown);
      if (!known) return answer(command, CommandAnswer::kRefused);
      orders.flag = static_cast<TrackFlag>(command.argument);
      return answer(command, CommandAnswer::kApplied);
    }
    case OperatorCommandKind::kSensorsExcluded:
      return exclude(command);
    case OperatorCommandKind::kFuelEntered:
      if (!(command.argument >= 0.0)) return answer(command, CommandAnswer::kRefused);
      orders.fuel_entered_l = command.argument;
      return answer(command, CommandAnswer::kApplied);
    case OperatorCommandKind::kRaceLine:
    case OperatorCommandKind::kRole:
    case OperatorCommandKind::kEndRun:
    case OperatorCommandKind::kSendParameters:
      break;  // this car drives one line, alone; the rest is for the I/O
  }
  answer(command, CommandAnswer::kUnsupported);
}

}  // namespace

safety::OperatorRequests execute(OperatorOrders& orders, const OrderInputs& inputs,
                                 Answers& answers) {
  OrderHandler handler{orders, inputs, answers};
  handler.give_what_was_let_go();
  if (inputs.switches.arm && !orders.switch_was) orders.arm.reset();
  orders.switch_was = inputs.switches.arm;
  orders.fuel_entered_l = kUnset;
  for (const OperatorCommand& command : inputs.commands) handler.take(command);

  safety::OperatorRequests requests = inputs.switches;
  requests.arm = inputs.may_arm && orders.arm.value_or(inputs.switches.arm);
  requests.reset = inputs.switches.reset || orders.reset;
  requests.stop = inputs.switches.stop || inputs.operator_inputs.stop == StopRequest::kControlled;
  requests.emergency_stop =
      inputs.switches.emergency_stop || inputs.operator_inputs.stop == StopRequest::kEmergency;
  return requests;
}

void conclude(OperatorOrders& orders, Mode before, const safety::SupervisorOutput& chosen,
              bool resettable, Instant now, Answers& answers) {
  if (orders.reset) {
    const bool left = before == Mode::kHalted && chosen.mode == Mode::kDisarmed;
    const bool done = left || resettable;
    (void)answers.push(
        {orders.reset->id, done ? CommandAnswer::kApplied : CommandAnswer::kRefused, now});
    orders.reset.reset();
  }
  if (!orders.arming || orders.close_next) return;
  const bool armed = chosen.mode != Mode::kDisarmed;
  (void)answers.push(
      {orders.arming->id, armed ? CommandAnswer::kApplied : CommandAnswer::kRefused, now});
  if (!armed) orders.arm = orders.arm_before;
  orders.arming.reset();
}

bool enough_to_drive(world::SensorUse use) {
  using enum world::Excludable;
  const bool position = use.uses(kGnss0) || use.uses(kGnss1);
  return position && (use.uses(kImu0) || use.uses(kImu1) || use.uses(kWheels));
}

world::RaceControl acted_on(const world::RaceControl& received, TrackFlag of_base,
                            double speed_max_mps) {
  world::RaceControl out = received;
  if (of_base != TrackFlag::kNone) {
    out.track = world::more_restrictive(of_base, received.track);
    out.conflict = out.conflict || of_base != received.track;
  }
  if (received.round_target_speed_mps > speed_max_mps) {
    out.round_target_speed_mps = speed_max_mps;
    out.refused_speed_mps = received.round_target_speed_mps;
  }
  return out;
}

}  // namespace pitwall::pipeline
