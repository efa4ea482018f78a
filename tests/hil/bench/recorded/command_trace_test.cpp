// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/recorded/command_trace.hpp"

#include <gtest/gtest.h>

#include "protocol/can/av21.hpp"
#include "tests/hil/bench/recorded/recorded_drive.hpp"

namespace pitwall::bench {
namespace {

CommandTrace recorded_trace() {
  auto run = RecordedRun::open(recorded_folder());
  auto trace = trace_of(*run, own_database());
  EXPECT_TRUE(trace) << to_string(trace.error());
  return *trace;
}

TEST(CommandTrace, HoldsModesAndCommandsOfTheRunByItsOwnTime) {
  const CommandTrace trace = recorded_trace();
  EXPECT_EQ(trace.ticks, kDrivenTicks);
  EXPECT_EQ(trace.length, kTick * static_cast<std::int64_t>(kDrivenTicks - 1));
  EXPECT_EQ(trace.first_frame, Duration{}) << "it says its state from the first tick on";
  EXPECT_FALSE(trace.armed_at_start);
  ASSERT_FALSE(trace.modes.empty());
  EXPECT_EQ(trace.modes.front().at, Duration{});
  EXPECT_EQ(trace.modes.front().value, 0.0) << "disarmed";
}

// The frames themselves, decoded by the code that the build generates from the same database.
TEST(CommandTrace, ItsCommandsAreThoseOfTheFrames) {
  const CommandTrace trace = recorded_trace();
  const auto& brake = trace.commands[static_cast<std::size_t>(Actuator::kBrake)];
  auto run = RecordedRun::open(recorded_folder());
  std::size_t next = 0;
  while (const auto tick = *run->next()) {
    for (const can::Frame& frame : tick->sent) {
      if (frame.id != can::av21::BrakePressureCmd::kId) continue;
      can::av21::BrakePressureCmd message;
      ASSERT_TRUE(can::av21::decode(frame, message));
      ASSERT_LT(next, brake.size());
      EXPECT_EQ(brake[next].at, tick->now - run->begun());
      EXPECT_EQ(brake[next++].value, message.brake_pressure_cmd);
    }
  }
  EXPECT_EQ(next, brake.size());
  EXPECT_GT(next, 0U);
}

TEST(CommandTrace, CountsTheInputsThatNoBusAndNoReceiverBrings) {
  const OtherInputs others = recorded_trace().others;
  EXPECT_EQ(others.guardian, 10U);
  EXPECT_EQ(others.controller, 2U) << "one more lost at tick 100 and at tick 200";
  EXPECT_EQ(others.joystick, 40U);
  EXPECT_EQ(others.silence, 0U) << "no base station was heard";
  EXPECT_EQ(recorded_trace().operator_texts.size(), 3U) << "two commands, a stop";
}

TEST(CommandTrace, ADatabaseWithoutTheCommandsIsRefused) {
  auto run = RecordedRun::open(recorded_folder());
  can::Database none;
  none.name = "none.dbc";
  const auto trace = trace_of(*run, none);
  ASSERT_FALSE(trace);
  EXPECT_EQ(to_string(trace.error()), "none.dbc: error: has no accelerator_cmd.acc_pedal_cmd");
}

}  // namespace
}  // namespace pitwall::bench
