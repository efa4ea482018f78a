// What the operator says, through the whole step: the car does it, and says what it did.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "tests/support/allocation_guard.hpp"
#include "tests/vehicle/pipeline/standing_car.hpp"
#include "vehicle/pipeline/telemetry_mapper.hpp"

namespace pitwall::pipeline {
namespace {

using testing::kStart;
using testing::kTick;
using testing::setup;
using world::CommandAnswer;
using world::Mode;
using world::OperatorCommand;
using world::OperatorCommandKind;

// A healthy car at standstill, told what to do by radio alone.
struct ReportedCar {
  testing::StandingCar source;
  std::unique_ptr<Car> car = std::make_unique<Car>();
  world::OperatorInputs operator_inputs;
  std::vector<world::AnsweredCommand> answers;
  Instant now = kStart;
  std::unique_ptr<Outputs> out = std::make_unique<Outputs>();
  std::uint32_t ids = 0;

  void tick(std::span<const OperatorCommand> commands = {}) {
    const testing::Received received = source.receive(now);
    Inputs in = received.inputs(now);
    in.operator_inputs = operator_inputs;
    in.commands = commands;
    *out = step(setup(), *car, in);
    answers.insert(answers.end(), out->answers.begin(), out->answers.end());
    now += kTick;
  }
  void run(Duration span) {
    for (const Instant end = now + span; now < end;) tick();
  }
  CommandAnswer say(OperatorCommandKind kind, double argument) {
    const OperatorCommand command{++ids, kind, argument, now + seconds(2)};
    answers.clear();
    tick({&command, 1});
    tick();
    EXPECT_EQ(answers.size(), 1U);
    return answers.empty() ? CommandAnswer::kRefused : answers.front().answer;
  }
  Mode mode() const { return out->chosen.mode; }
};

TEST(OperatorStep, ArmsDrivesStopsAndArmsAgainByRadioAlone) {
  ReportedCar t;
  t.run(seconds(3));
  EXPECT_EQ(t.mode(), Mode::kDisarmed);
  EXPECT_EQ(t.say(OperatorCommandKind::kArm, 1.0), CommandAnswer::kApplied);
  t.run(milliseconds(300));
  ASSERT_EQ(t.mode(), Mode::kDriving);
  t.operator_inputs.stop = world::StopRequest::kControlled;
  t.run(seconds(2));
  EXPECT_EQ(t.mode(), Mode::kHalted);
  EXPECT_EQ(t.out->chosen.cause, safety::Cause::kOperatorStop);
  EXPECT_EQ(t.say(OperatorCommandKind::kArm, 1.0), CommandAnswer::kRefused);
  t.operator_inputs.stop = world::StopRequest::kNone;
  EXPECT_EQ(t.say(OperatorCommandKind::kReset, 1.0), CommandAnswer::kApplied);
  EXPECT_EQ(t.mode(), Mode::kDisarmed);
  EXPECT_EQ(t.say(OperatorCommandKind::kArm, 1.0), CommandAnswer::kApplied);
  t.run(milliseconds(300));
  EXPECT_EQ(t.mode(), Mode::kDriving);
  EXPECT_EQ(t.say(OperatorCommandKind::kArm, 0.0), CommandAnswer::kApplied);
  t.run(seconds(2));
  EXPECT_EQ(t.mode(), Mode::kHalted);
}

TEST(OperatorStep, ALatchedStopBarsArming) {
  ReportedCar t;
  t.operator_inputs.stop = world::StopRequest::kEmergency;
  t.run(seconds(3));
  EXPECT_EQ(t.say(OperatorCommandKind::kArm, 1.0), CommandAnswer::kRefused);
  t.operator_inputs.stop = world::StopRequest::kNone;
  t.run(seconds(1));
  EXPECT_EQ(t.mode(), Mode::kDisarmed) << "the refused request does not wait";
}

TEST(OperatorStep, TheBasesRedHoldsACarThatRaceControlWavesOff) {
  ReportedCar t;
  t.run(seconds(3));
  EXPECT_EQ(t.say(OperatorCommandKind::kTrackFlag, 1.0), CommandAnswer::kApplied);
  EXPECT_EQ(t.say(OperatorCommandKind::kArm, 1.0), CommandAnswer::kApplied);
  t.run(seconds(1));
  EXPECT_EQ(t.mode(), Mode::kStandby);
  EXPECT_EQ(t.out->race_control.track, world::TrackFlag::kRed);
  EXPECT_EQ(t.out->received.race_control.track, world::TrackFlag::kGreen);
  EXPECT_EQ(t.say(OperatorCommandKind::kTrackFlag, 0.0), CommandAnswer::kApplied);
  t.run(seconds(1));
  EXPECT_EQ(t.mode(), Mode::kDriving);
}

TEST(OperatorStep, TheSpeedLimitReachesThePlan) {
  ReportedCar t;
  t.run(seconds(3));
  EXPECT_EQ(t.say(OperatorCommandKind::kSpeedLimit, 7.5), CommandAnswer::kApplied);
  t.run(milliseconds(100));
  EXPECT_EQ(t.out->speed_limit_mps, 7.5);
  EXPECT_EQ(t.car->plan.output.reason, planning::Reason::kOperatorLimit);
  for (const auto& point : t.car->plan.output.drive.points) EXPECT_LE(point.speed_mps, 7.51);
}

// In the very tick in which the command comes, until the next set is ordered; and told.
TEST(OperatorStep, AnExcludedReceiverIsNotBelievedFromThisTickOn) {
  ReportedCar t;
  t.run(seconds(3));
  const auto gates_of_unit_0 = [&] {
    std::vector<localization::Gate> gates;
    for (const localization::Verdict& v : t.out->located)
      if (v.source == localization::Source::kPosition && v.unit == 0) gates.push_back(v.gate);
    return gates;
  };
  const auto until_a_position = [&] {
    while ((t.now - kStart) / kTick % 5 != 0) t.tick();
  };
  until_a_position();
  const OperatorCommand exclude{++t.ids, OperatorCommandKind::kSensorsExcluded, 1.0,
                                t.now + seconds(2)};
  t.answers.clear();
  t.tick({&exclude, 1});
  ASSERT_EQ(t.answers.size(), 1U);
  EXPECT_EQ(t.answers.front().answer, CommandAnswer::kApplied);
  EXPECT_EQ(gates_of_unit_0(), std::vector{localization::Gate::kExcluded});
  t.run(seconds(5));
  EXPECT_EQ(t.out->ego.validity, world::Validity::kGood) << "by the other one";
  EXPECT_EQ(t.car->orders.use.excluded, 1) << "it stays";
  TickLog log;
  const auto reported = map_telemetry(
      {.setup = setup(), .car = *t.car, .out = *t.out, .log = log, .io = {}, .now = t.now});
  EXPECT_EQ(reported.values[telemetry::field("localization.excluded")], 1.0);
  EXPECT_EQ(t.say(OperatorCommandKind::kSensorsExcluded, 0.0), CommandAnswer::kApplied);
  t.run(seconds(3));
  until_a_position();
  t.tick();
  EXPECT_EQ(gates_of_unit_0(), std::vector{localization::Gate::kAccepted});
}

TEST(OperatorStep, AJoystickLowersTheThrottleUntilItsSampleIsOld) {
  ReportedCar t;
  t.run(seconds(3));
  t.say(OperatorCommandKind::kArm, 1.0);
  t.run(seconds(2));
  ASSERT_EQ(t.mode(), Mode::kDriving);
  ASSERT_GT(t.out->chosen.command.throttle_fraction, 0.0);
  t.operator_inputs.joystick = world::Joystick{.throttle_cap = 0.0, .brake = 0.5, .at = t.now};
  t.tick();
  EXPECT_EQ(t.out->chosen.command.throttle_fraction, 0.0);
  EXPECT_GT(t.out->chosen.command.brake_kpa, 0.0);
  t.run(seconds(2));  // the I/O repeats it; its age is checked here
  EXPECT_GT(t.out->chosen.command.throttle_fraction, 0.0);
  EXPECT_EQ(t.out->radio.throttle_cap, 1.0);
}

// Anything an operator or broken I/O may hand over: one answer each, no heap, nothing refused by
// the frame gate.
TEST(OperatorStep, WhateverIsSaidIsAnsweredOnceWithoutTheHeapOrTheGate) {
  Random random{7};
  ReportedCar t;
  std::vector<int> answered(100'000);
  std::vector<OperatorCommand> commands;
  for (int i = 0; i < 2'000; ++i) {
    commands.clear();
    while (random.one_in(2) && commands.size() < world::kOperatorCommandsMax) {
      const Instant expires = t.now + milliseconds(static_cast<int>(random.below(200)) - 100);
      commands.push_back({++t.ids, static_cast<OperatorCommandKind>(random.below(9)),
                          random.one_in(2) ? 1.0 : any_number(random), expires});
    }
    t.operator_inputs.stop = random.one_in(50) ? static_cast<world::StopRequest>(random.below(3))
                                               : world::StopRequest::kNone;
    t.operator_inputs.joystick.reset();
    if (random.one_in(3)) {
      const Duration age = milliseconds(static_cast<int>(random.below(400)) - 100);
      t.operator_inputs.joystick =
          world::Joystick{any_number(random), any_number(random), t.now - age};
    }
    const testing::Received received = t.source.receive(t.now);
    Inputs in = received.inputs(t.now);
    in.operator_inputs = t.operator_inputs;
    in.commands = commands;
    const auto allocations =
        pitwall::testing::allocations_of([&] { *t.out = step(setup(), *t.car, in); });
    if (pitwall::testing::kAllocationsCounted) {
      ASSERT_EQ(allocations, 0U);
    }
    for (const world::AnsweredCommand& one : t.out->answers) ++answered.at(one.id);
    ASSERT_EQ(t.out->passed.refused_total, 0U) << i;
    t.now += kTick;
  }
  t.answers.clear();
  t.run(milliseconds(50));
  for (const world::AnsweredCommand& one : t.answers) ++answered.at(one.id);
  for (std::uint32_t id = 1; id <= t.ids; ++id) ASSERT_EQ(answered[id], 1) << id;
}

}  // namespace
}  // namespace pitwall::pipeline
