// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/recorded/command_comparison.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/hil/bench/recorded/recorded_drive.hpp"

namespace pitwall::bench {
namespace {

constexpr auto kBrake = static_cast<std::size_t>(Actuator::kBrake);
constexpr auto kGear = static_cast<std::size_t>(Actuator::kGear);
constexpr double kMode_disarmed = 0.0, kMode_standby = 1.0, kMode_driving = 2.0;
constexpr double kMode_emergency_stop = 4.0;

CommandTolerances tolerances() {
  return tolerances_of(pipeline::testing::setup().params, own_database());
}

// A second of a brake that rises by 10 kPa a tick from `begin`, and one gear change.
CommandTrace trace(Duration late = {}, double offset_kpa = 0.0) {
  CommandTrace out;
  for (std::int64_t tick = 0; tick < 100; ++tick) {
    const Duration at = kTick * tick;
    const double kpa = 1000.0 * std::max(0.0, (at - late).seconds() - 0.2);
    out.commands[kBrake].push_back({at, kpa + offset_kpa});
    out.commands[kGear].push_back({at, at - late < milliseconds(500) ? 1.0 : 2.0});
  }
  out.modes = {{Duration{}, kMode_disarmed},
               {milliseconds(100) + late, kMode_standby},
               {milliseconds(600) + late, kMode_driving}};
  out.length = kTick * 99;
  out.ticks = 100;
  return out;
}

std::vector<std::string> signals_of(const CommandComparison& comparison) {
  std::vector<std::string> out;
  for (const SignalDifference& difference : comparison.differences)
    out.push_back(difference.signal);
  return out;
}

TEST(CommandComparison, TolerancesAreWhatTheSlewLimitsLetChangeInATickAndOneStep) {
  const CommandTolerances own = tolerances();
  EXPECT_EQ(own.lag(), milliseconds(20));
  EXPECT_EQ(own.command_lag(), milliseconds(70));
  EXPECT_EQ(own.mode_lag(), milliseconds(40));
  // av21.yaml: throttle falls by 5 a second, brake by 30,000 kPa/s, steering 0.5 rad/s by 19.5;
  // steps of av21.dbc: 0.01 %, 1 kPa, 0.5 deg.
  EXPECT_NEAR(own.command[0], 5.01, 1e-9);
  EXPECT_NEAR(own.command[1], 301.0, 1e-9);
  EXPECT_NEAR(own.command[2], 0.5 * 19.5 * 180.0 / 3.14159265358979 * 0.01 + 0.5, 1e-6);
  EXPECT_EQ(own.command[3], 0.0);
}

TEST(CommandComparison, ARunThatIsTwoTicksLateIsTheSameAndOneThatIsTwelveLateIsNot) {
  const CommandComparison same = compare(trace(), trace(kTick * 2), tolerances());
  EXPECT_TRUE(same.differences.empty()) << same.differences[0].signal;
  EXPECT_EQ(same.modes, 3U);
  EXPECT_EQ(same.commands, 200U);
  const CommandComparison late = compare(trace(), trace(kTick * 12), tolerances());
  EXPECT_EQ(signals_of(late),
            (std::vector<std::string>{"mode.mode (seconds)", "gear_shift_cmd.desired_gear"}));
  EXPECT_EQ(late.differences[0].values, 2U) << "both changes";
  EXPECT_EQ(late.differences[1].first.at, Instant{} + milliseconds(500));
  EXPECT_EQ(late.differences[1].context, "in mode standby");
}

TEST(CommandComparison, ACommandBeyondItsToleranceIsNamedWithTimeAndSize) {
  CommandTrace again = trace({}, 300.0);
  EXPECT_TRUE(compare(trace(), again, tolerances()).differences.empty()) << "within 301 kPa";
  for (std::size_t i = 30; i < 60; ++i) again.commands[kBrake][i].value += 500.0;
  const auto found = compare(trace(), again, tolerances()).differences;
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].signal, "brake_pressure_cmd.brake_pressure_cmd");
  EXPECT_EQ(found[0].first.tick, 37U) << "seven ticks in, the value before is too far back";
  EXPECT_GT(found[0].largest.size(), 301.0);
}

TEST(CommandComparison, OtherModesAndModesThatOnlyOneRunHasAreADifference) {
  CommandTrace again = trace();
  again.modes[2].value = 4.0;
  auto found = compare(trace(), again, tolerances()).differences;
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].signal, "mode.mode");
  EXPECT_EQ(found[0].first.recorded, kMode_driving);
  EXPECT_EQ(found[0].first.again, 4.0);
  again.modes.pop_back();
  found = compare(trace(), again, tolerances()).differences;
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].first.recorded, kMode_driving);
  EXPECT_EQ(found[0].first.again, kMode_standby);
  found = compare(again, trace(), tolerances()).differences;
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].first.recorded, kMode_standby);
  EXPECT_EQ(found[0].first.again, kMode_driving);
}

TEST(CommandComparison, AModeThatEndsWithinTheLagMayBeMissingAndALongerOneMayNot) {
  for (const std::int64_t ticks : {1, 4, 5}) {
    CommandTrace again = trace();
    const CommandSample passed{again.modes[2].at - kTick * ticks, kMode_emergency_stop};
    again.modes.insert(again.modes.begin() + 2, passed);
    const bool is_same = ticks <= 4;
    EXPECT_EQ(compare(trace(), again, tolerances()).differences.empty(), is_same) << ticks;
    EXPECT_EQ(compare(again, trace(), tolerances()).differences.empty(), is_same) << ticks;
  }
}

TEST(CommandComparison, CommandsOfOneRunOnlyAndARunThatEndsEarlyAreDifferences) {
  CommandTrace again = trace();
  auto& brake = again.commands[kBrake];
  brake.erase(brake.begin() + 40, brake.begin() + 60);
  auto found = compare(trace(), again, tolerances()).differences;
  ASSERT_EQ(signals_of({.differences = found}),
            (std::vector<std::string>{"brake_pressure_cmd.brake_pressure_cmd (frame)"}));
  EXPECT_EQ(found[0].values, 6U) << "seven ticks of either end are near enough";
  EXPECT_EQ(found[0].first.again, 0.0);
  found = compare(again, trace(), tolerances()).differences;
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].first.again, 1.0);
  again = trace();
  again.length = again.length - milliseconds(30);
  EXPECT_EQ(signals_of(compare(trace(), again, tolerances())),
            (std::vector<std::string>{"run (seconds)"}));
}

}  // namespace
}  // namespace pitwall::bench
