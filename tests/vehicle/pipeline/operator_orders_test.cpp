// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/operator_orders.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pitwall::pipeline {
namespace {

using world::CommandAnswer;
using world::Mode;
using world::OperatorCommand;
using world::OperatorCommandKind;
using world::TrackFlag;

constexpr double kFastest_mps = 68.0;  // of the car's file

// The orders, and a supervisor that arms what it is allowed to.
struct Rig {
  OperatorOrders orders;
  safety::OperatorRequests switches;
  world::OperatorInputs operator_inputs;
  Mode mode = Mode::kDisarmed;
  bool barred = false, may_arm = true, resettable = false, arm_used = false, stands = true;
  Instant now{seconds(1).ns};
  safety::OperatorRequests received;
  Answers answers;
  std::uint32_t next_id = 1;

  std::uint32_t tick(std::vector<OperatorCommand> commands = {}) {
    answers = {};
    for (OperatorCommand& command : commands) {
      if (command.id == 0) command.id = next_id++;
      if (command.expires.ns == 0) command.expires = now + seconds(2);
    }
    received = execute(orders,
                       {.switches = switches,
                        .operator_inputs = operator_inputs,
                        .commands = commands,
                        .may_arm = may_arm,
                        .mode = mode,
                        .stands = stands,
                        .now = now},
                       answers);
    const Mode before = mode;
    if (!received.arm) arm_used = false;
    if (mode == Mode::kDisarmed && received.arm && !barred && !arm_used) {
      mode = Mode::kStandby;
      arm_used = true;
    }
    if (mode == Mode::kStandby && !received.arm) mode = Mode::kDisarmed;
    if (mode == Mode::kHalted && received.reset) mode = Mode::kDisarmed;
    safety::SupervisorOutput chosen;
    chosen.mode = mode;
    conclude(orders, before, chosen, resettable, now, answers);
    now += milliseconds(10);
    return commands.empty() ? 0 : commands.back().id;
  }
  std::optional<CommandAnswer> answer(std::uint32_t id) const {
    for (const world::AnsweredCommand& one : answers)
      if (one.id == id) return one.answer;
    return std::nullopt;
  }
  // Ticks until the command is answered.
  CommandAnswer done(OperatorCommandKind kind, double argument) {
    const std::uint32_t id = tick({{.kind = kind, .argument = argument}});
    for (int i = 0; i < 3; ++i) {
      if (const auto a = answer(id)) return *a;
      tick();
    }
    ADD_FAILURE() << "no answer";
    return CommandAnswer::kRefused;
  }
};

TEST(OperatorOrders, ArmsByCommandAndSaysAppliedWhenTheCarIsArmed) {
  Rig rig;
  EXPECT_EQ(rig.done(OperatorCommandKind::kArm, 1.0), CommandAnswer::kApplied);
  EXPECT_EQ(rig.mode, Mode::kStandby);
  EXPECT_TRUE(rig.received.arm);
  EXPECT_EQ(rig.done(OperatorCommandKind::kArm, 1.0), CommandAnswer::kApplied) << "it is armed";
  EXPECT_EQ(rig.mode, Mode::kStandby) << "saying it again let nothing go";
  EXPECT_EQ(rig.done(OperatorCommandKind::kArm, 0.0), CommandAnswer::kApplied);
  EXPECT_EQ(rig.mode, Mode::kDisarmed);
}

TEST(OperatorOrders, AnArmCommandThatIsBarredIsRefusedAndDoesNotLieInWait) {
  Rig rig;
  rig.barred = true;
  EXPECT_EQ(rig.done(OperatorCommandKind::kArm, 1.0), CommandAnswer::kRefused);
  rig.barred = false;
  for (int i = 0; i < 100; ++i) rig.tick();
  EXPECT_EQ(rig.mode, Mode::kDisarmed);
}

TEST(OperatorOrders, AfterAStopAResetAndAnArmCommandAreEnough) {
  Rig rig;
  rig.done(OperatorCommandKind::kArm, 1.0);
  rig.mode = Mode::kHalted;
  EXPECT_EQ(rig.done(OperatorCommandKind::kArm, 1.0), CommandAnswer::kRefused);
  EXPECT_EQ(rig.done(OperatorCommandKind::kReset, 1.0), CommandAnswer::kApplied);
  EXPECT_EQ(rig.mode, Mode::kDisarmed) << "the arm request of before is spent";
  EXPECT_EQ(rig.done(OperatorCommandKind::kArm, 1.0), CommandAnswer::kApplied);
  EXPECT_EQ(rig.mode, Mode::kStandby);
}

TEST(OperatorOrders, TheSwitchAtTheCarWorksAsWithoutARadioAndHasTheLastWordWhenItIsClosed) {
  Rig rig;
  rig.switches.arm = true;
  rig.tick();
  EXPECT_EQ(rig.mode, Mode::kStandby);
  EXPECT_EQ(rig.done(OperatorCommandKind::kArm, 0.0), CommandAnswer::kApplied);
  for (int i = 0; i < 10; ++i) rig.tick();
  EXPECT_EQ(rig.mode, Mode::kDisarmed) << "held closed it is not closed again";
  rig.switches.arm = false;
  rig.tick();
  rig.switches.arm = true;
  rig.tick();
  EXPECT_EQ(rig.mode, Mode::kStandby);
}

TEST(OperatorOrders, WhoOnlyListensIsNotArmed) {
  Rig rig;
  rig.may_arm = false;
  rig.switches.arm = true;
  EXPECT_EQ(rig.done(OperatorCommandKind::kArm, 1.0), CommandAnswer::kRefused);
  EXPECT_FALSE(rig.received.arm);
}

TEST(OperatorOrders, NothingIsAppliedAfterItsExpiry) {
  for (const auto kind : {OperatorCommandKind::kArm, OperatorCommandKind::kReset,
                          OperatorCommandKind::kSpeedLimit, OperatorCommandKind::kTrackFlag}) {
    Rig rig;
    const auto id =
        rig.tick({{.kind = kind, .argument = 1.0, .expires = rig.now - nanoseconds(1)}});
    EXPECT_EQ(rig.answer(id), CommandAnswer::kExpired);
  }
  Rig rig;  // expires while the arm request is let go
  const auto id = rig.tick(
      {{.kind = OperatorCommandKind::kArm, .argument = 1.0, .expires = rig.now + milliseconds(5)}});
  rig.tick();
  EXPECT_EQ(rig.answer(id), CommandAnswer::kExpired);
  EXPECT_EQ(rig.mode, Mode::kDisarmed);
}

TEST(OperatorOrders, AResetIsAppliedWhereThereIsSomethingToReset) {
  Rig rig;
  EXPECT_EQ(rig.done(OperatorCommandKind::kReset, 1.0), CommandAnswer::kRefused);
  EXPECT_EQ(rig.done(OperatorCommandKind::kReset, 0.0), CommandAnswer::kRefused);
  rig.resettable = true;
  EXPECT_EQ(rig.done(OperatorCommandKind::kReset, 1.0), CommandAnswer::kApplied);
  rig.tick();
  EXPECT_FALSE(rig.received.reset) << "for one tick only";
}

TEST(OperatorOrders, AResetWaitsUntilTheCarStands) {
  Rig rig;
  rig.resettable = true;
  rig.stands = false;
  EXPECT_EQ(rig.done(OperatorCommandKind::kReset, 1.0), CommandAnswer::kRefused);
  rig.stands = true;
  EXPECT_EQ(rig.done(OperatorCommandKind::kReset, 1.0), CommandAnswer::kApplied);
}

// Every set, at rest and moving: what leaves a moving car without a position or without a sense of
// its motion is refused, and what is refused changes nothing.
TEST(OperatorOrders, SensorsAreExcludedBySetAndStayExcluded) {
  for (const bool stands : {false, true}) {
    Rig rig;
    rig.stands = stands;
    std::uint16_t held = 0;
    for (unsigned set = 0; set < 1U << world::kExcludables; ++set) {
      const bool blind = (set & 3U) == 3U, numb = (set >> 2U & 7U) == 7U;
      const auto answer = rig.done(OperatorCommandKind::kSensorsExcluded, static_cast<double>(set));
      const bool refused = !stands && (blind || numb);
      EXPECT_EQ(answer, refused ? CommandAnswer::kRefused : CommandAnswer::kApplied) << set;
      if (!refused) held = static_cast<std::uint16_t>(set);
      for (int i = 0; i < 3; ++i) rig.tick();
      EXPECT_EQ(rig.orders.use.excluded, held) << set;
    }
  }
}

TEST(OperatorOrders, WhatIsNoSetOfSensorsIsRefused) {
  Rig rig;
  for (const double argument : {-1.0, 0.5, 512.0, 1e9, kUnset})
    EXPECT_EQ(rig.done(OperatorCommandKind::kSensorsExcluded, argument), CommandAnswer::kRefused);
  EXPECT_EQ(rig.orders.use, world::SensorUse{});
}

TEST(OperatorOrders, TheFuelEnteredIsThatOfOneTick) {
  Rig rig;
  EXPECT_EQ(rig.done(OperatorCommandKind::kFuelEntered, 31.5), CommandAnswer::kApplied);
  EXPECT_EQ(rig.orders.fuel_entered_l, 31.5);
  rig.tick();
  EXPECT_TRUE(std::isnan(rig.orders.fuel_entered_l)) << "an entry of before is none";
  for (const double argument : {-1.0, kUnset})
    EXPECT_EQ(rig.done(OperatorCommandKind::kFuelEntered, argument), CommandAnswer::kRefused);
}

TEST(OperatorOrders, WhatThisCarDoesNotHaveIsUnsupported) {
  for (const auto kind : {OperatorCommandKind::kRaceLine, OperatorCommandKind::kRole,
                          OperatorCommandKind::kEndRun, OperatorCommandKind::kSendParameters}) {
    Rig rig;
    EXPECT_EQ(rig.done(kind, 1.0), CommandAnswer::kUnsupported);
  }
}

TEST(OperatorOrders, EveryCommandOfATickIsAnsweredOnce) {
  Rig rig;
  std::vector<OperatorCommand> commands(world::kOperatorCommandsMax);
  for (std::size_t i = 0; i < commands.size(); ++i) {
    commands[i].kind = static_cast<OperatorCommandKind>(i % 10);
    commands[i].argument = 1.0;
  }
  std::vector<int> answered(commands.size() + 1);
  rig.tick(commands);
  for (int i = 0; i < 3; ++i, rig.tick())
    for (const world::AnsweredCommand& one : rig.answers) ++answered.at(one.id);
  for (std::size_t id = 1; id < answered.size(); ++id) EXPECT_EQ(answered[id], 1) << id;
}

TEST(OperatorOrders, ALatchedStopIsARequest) {
  Rig rig;
  rig.operator_inputs.stop = world::StopRequest::kControlled;
  rig.tick();
  EXPECT_TRUE(rig.received.stop);
  EXPECT_FALSE(rig.received.emergency_stop);
  rig.operator_inputs.stop = world::StopRequest::kEmergency;
  rig.tick();
  EXPECT_TRUE(rig.received.emergency_stop);
}

TEST(OperatorOrders, OfTwoFlagsTheStricterHolds) {
  const std::vector<TrackFlag> by_strictness{
      TrackFlag::kWavingGreen, TrackFlag::kGreen, TrackFlag::kYellow, TrackFlag::kChequered,
      TrackFlag::kOrange,      TrackFlag::kRed,   TrackFlag::kUnknown};
  for (std::size_t can = 0; can < by_strictness.size(); ++can) {
    world::RaceControl received;
    received.track = by_strictness[can];
    received.raw_track = 9;
    EXPECT_EQ(acted_on(received, TrackFlag::kNone, kFastest_mps).track, received.track)
        << "no opinion";
    for (std::size_t base = 0; base < by_strictness.size(); ++base) {
      const world::RaceControl held = acted_on(received, by_strictness[base], kFastest_mps);
      EXPECT_EQ(held.track, by_strictness[std::max(can, base)]);
      EXPECT_EQ(held.raw_track, 9) << "what was heard is acknowledged as it was";
      EXPECT_EQ(held.conflict, can != base);
    }
  }
  EXPECT_EQ(acted_on({}, TrackFlag::kGreen, kFastest_mps).track, TrackFlag::kNone)
      << "the base cannot wave a car off that race control has not";
}

TEST(OperatorOrders, ARoundSpeedAboveTheCarsIsCappedAndTold) {
  world::RaceControl received;
  for (const double asked_mps : {kUnset, 30.0, kFastest_mps, 71.5}) {
    received.round_target_speed_mps = asked_mps;
    const world::RaceControl held = acted_on(received, TrackFlag::kNone, kFastest_mps);
    const bool too_fast = asked_mps > kFastest_mps;
    EXPECT_EQ(std::isfinite(held.refused_speed_mps), too_fast) << asked_mps;
    if (std::isnan(asked_mps)) {
      EXPECT_TRUE(std::isnan(held.round_target_speed_mps));
      continue;
    }
    EXPECT_EQ(held.round_target_speed_mps, std::min(asked_mps, kFastest_mps));
    if (!too_fast) continue;
    EXPECT_EQ(held.refused_speed_mps, asked_mps);
  }
}

TEST(OperatorOrders, ASpeedLimitHoldsAndNoNegativeOneIsTaken) {
  Rig rig;
  EXPECT_EQ(rig.done(OperatorCommandKind::kSpeedLimit, 33.0), CommandAnswer::kApplied);
  EXPECT_EQ(rig.orders.speed_limit_mps, 33.0);
  EXPECT_EQ(rig.done(OperatorCommandKind::kSpeedLimit, -1.0), CommandAnswer::kRefused);
  EXPECT_EQ(rig.done(OperatorCommandKind::kTrackFlag, 99.0), CommandAnswer::kRefused);
}

}  // namespace
}  // namespace pitwall::pipeline
