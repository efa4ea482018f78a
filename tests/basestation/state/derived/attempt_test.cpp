// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/attempt.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/basestation/state/derived/flag_values.hpp"
#include "tests/basestation/state/derived/lap.hpp"

namespace pitwall::state {
namespace {

constexpr double kNothing = 0, kAttemptLaps = 2.0;
constexpr Duration kTick = milliseconds(100);

// A car at 60 m/s, heard ten times a second.
struct Race {
  AttemptTracker tracker;
  RaceSample sample{.track_flag = kGreen,
                    .vehicle_flag = kAttacker,
                    .lap = 3,
                    .station_m = 500.0,
                    .course_m = kLap_m};
  Instant now{seconds(100).ns};
  double driven_m = 500.0;
  int lap_lags = 0;  // samples that the lap number comes after the station

  void drive(Duration span, bool received = true) {
    for (Duration done{}; done < span; done = done + kTick) {
      now += kTick;
      driven_m += 60.0 * kTick.seconds();
      sample.station_m = std::fmod(driven_m, kLap_m);
      const double counted_m = driven_m - 60.0 * kTick.seconds() * lap_lags;
      sample.lap = 3.0 + std::floor(counted_m / kLap_m);
      if (received) say();
    }
  }
  void show(double flag, Duration span = kTick) {
    sample.track_flag = flag;
    drive(span);
  }
  void say() { tracker.receive(sample, kAttemptLaps, now); }
  Attempt at() const { return tracker.attempt(); }
};

TEST(Attempt, BeginsWithTheWavingGreenFlagAndCountsItsLaps) {
  Race race;
  race.drive(seconds(5));
  EXPECT_TRUE(std::isnan(race.at().number));
  race.show(kWaving, seconds(40));  // a lap
  EXPECT_EQ(race.at().number, 1.0);
  EXPECT_NEAR(race.at().laps, 1.0, 0.01);
  EXPECT_EQ(race.at().state, AttemptState::kRunning);
  race.drive(seconds(41));
  EXPECT_NEAR(race.at().laps, 2.02, 0.01);
  EXPECT_EQ(race.at().state, AttemptState::kUsedUp);
  race.show(kGreen, seconds(5));
  race.show(kWaving, seconds(1));
  EXPECT_EQ(race.at().number, 2.0);
  EXPECT_LT(race.at().laps, 0.1);
}

TEST(Attempt, IsNoneForACarWithoutARole) {
  Race race;
  race.sample.vehicle_flag = 0.0;
  race.show(kWaving, seconds(10));
  EXPECT_TRUE(std::isnan(race.at().number));
  race.sample.vehicle_flag = kDefender;
  race.drive(seconds(1));
  EXPECT_EQ(race.at().number, 1.0);
}

// What looks like the end of an attempt, and is none.
TEST(Attempt, NeitherAFlickerNorAnUnknownFlagNorSilenceEndsIt) {
  Race race;
  race.show(kWaving, seconds(10));
  race.show(kYellow, milliseconds(800));
  race.show(kWaving, seconds(5));
  race.show(kUnknownFlag, seconds(8));
  race.show(kNothing, seconds(3));
  race.show(kUnset, seconds(3));
  race.sample.vehicle_flag = kUnset;
  race.show(kWaving, seconds(2));
  race.sample.vehicle_flag = kAttacker;
  race.show(kWaving, seconds(2));
  EXPECT_EQ(race.at().number, 1.0);
  EXPECT_EQ(race.at().state, AttemptState::kRunning);
  EXPECT_NEAR(race.at().laps, 33.8 * 60.0 / kLap_m, 0.01);
}

TEST(Attempt, AnotherFlagOrTheOtherRoleEndsIt) {
  Race race;
  race.show(kWaving, seconds(10));
  race.show(kYellow, milliseconds(1'300));
  EXPECT_EQ(race.at().state, AttemptState::kEnded);
  race.show(kWaving, seconds(1));
  EXPECT_EQ(race.at().number, 2.0);
  race.sample.vehicle_flag = kDefender;
  race.drive(seconds(2));
  EXPECT_EQ(race.at().number, 3.0);
  EXPECT_EQ(race.at().state, AttemptState::kRunning);
}

// The lap number comes later than the station, or earlier: a lap is still one.
TEST(Attempt, TheStartLineCountsOnce) {
  for (const int lags : {-2, 0, 3}) {
    Race race;
    race.lap_lags = lags;
    race.show(kWaving, seconds(40));
    EXPECT_NEAR(race.at().laps, 1.0, 0.01) << lags;
  }
}

TEST(Attempt, WhatNobodyHeardWasDriven) {
  Race race;
  race.show(kWaving, seconds(4));
  race.drive(seconds(60), false);  // a lap and a half
  race.drive(seconds(1));
  EXPECT_NEAR(race.at().laps, 65.0 * 60.0 / kLap_m, 0.01);
}

TEST(Attempt, ALapNumberThatRunsBackKeepsWhatWasDriven) {
  Race race;
  race.show(kWaving, seconds(20));
  race.drive(seconds(5), false);
  race.sample.lap = 0;  // the car was started again
  race.say();
  EXPECT_NEAR(race.at().laps, 25.0 * 60.0 / kLap_m, 0.01);
}

TEST(Attempt, WithoutACourseWholeLapsCount) {
  Race race;
  race.sample.course_m = kUnset;
  race.show(kWaving, seconds(39));
  EXPECT_EQ(race.at().laps, 1.0);  // across the line once
}

TEST(Attempt, AStandingCarDrivesNoLaps) {
  Race race;
  race.show(kWaving, seconds(1));
  const double before = race.at().laps;
  for (int i = 0; i < 10'000; ++i) {
    race.now += kTick;
    race.sample.station_m += i % 2 == 0 ? 0.1 : -0.1;
    race.say();
  }
  EXPECT_NEAR(race.at().laps, before, 1e-3);
}

// Gap to the opponent over time: ahead, beside, behind.
void pass_by(Race& race, double until_gap_m) {
  for (double gap = 20.0; gap > 0.0; gap -= 1.0) {
    race.sample.gap_ahead_m = gap;
    race.drive(kTick);
  }
  race.sample.gap_ahead_m = race.sample.gap_behind_m = 0.0;
  race.drive(kTick);
  race.sample.gap_ahead_m = kUnset;
  for (double gap = 1.0; gap <= until_gap_m; gap += 1.0) {
    race.sample.gap_behind_m = gap;
    race.drive(kTick);
  }
}

TEST(Attempt, ThirtyMetresAheadIsAPass) {
  Race race;
  race.show(kWaving, seconds(1));
  pass_by(race, 29.0);
  EXPECT_EQ(race.at().state, AttemptState::kRunning);
  race.sample.gap_behind_m = 30.0;
  race.drive(kTick);
  EXPECT_EQ(race.at().state, AttemptState::kPassed);
  race.drive(seconds(90));  // and stays one
  EXPECT_EQ(race.at().state, AttemptState::kPassed);
}

TEST(Attempt, NoPassWithoutHavingBeenBehindOrAsDefender) {
  Race ahead;
  ahead.show(kWaving, seconds(1));
  ahead.sample.gap_behind_m = 50.0;
  ahead.drive(seconds(5));
  EXPECT_EQ(ahead.at().state, AttemptState::kRunning);
  Race defender;
  defender.sample.vehicle_flag = kDefender;
  defender.show(kWaving, seconds(1));
  pass_by(defender, 40.0);
  EXPECT_EQ(defender.at().state, AttemptState::kRunning);
}

// Half a lap apart, "ahead" becomes "behind" while nobody passes anybody.
TEST(Attempt, TheOtherHalfOfTheLapIsNoPass) {
  Race race;
  race.show(kWaving, seconds(1));
  race.sample.gap_ahead_m = kLap_m / 2 - 10.0;
  race.drive(seconds(1));
  race.sample.gap_ahead_m = kUnset;
  race.sample.gap_behind_m = kLap_m / 2 - 10.0;
  race.drive(seconds(1));
  EXPECT_EQ(race.at().state, AttemptState::kRunning);
}

TEST(Attempt, AnOpponentThatIsNotSeenAnyMoreIsNotPassed) {
  Race race;
  race.show(kWaving, seconds(1));
  race.sample.gap_ahead_m = 20.0;
  race.drive(seconds(1));
  race.sample.gap_ahead_m = kUnset;
  race.drive(seconds(5));
  EXPECT_EQ(race.at().state, AttemptState::kRunning);
}

TEST(Attempt, RolesComeFromRaceControlsFlag) {
  EXPECT_EQ(role_of_flag(kDefender), Role::kDefender);
  EXPECT_EQ(role_of_flag(kAttacker), Role::kAttacker);
  EXPECT_EQ(role_of_flag(2.0), Role::kNone);
  EXPECT_EQ(role_of_flag(11.0), std::nullopt);
  EXPECT_EQ(role_of_flag(kUnset), std::nullopt);
}

}  // namespace
}  // namespace pitwall::state
