// SPDX-License-Identifier: Apache-2.0
#include "protocol/rules/fuel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

namespace pitwall::rules {
namespace {

// A car that burns so much per lap, heard twice in each lap's second.
struct Car {
  FuelEstimator estimator;
  double level_l, used_l = 0.0, lap = 0.0, slosh_l = 0.0;
  bool counts_used = true;

  explicit Car(double level) : level_l(level) {}
  void drive_lap(double burn_l) {
    constexpr int kParts = 20;
    for (int i = 0; i < kParts; ++i) {
      level_l -= burn_l / kParts;
      used_l += burn_l / kParts;
      say(i % 2 == 0 ? slosh_l : -slosh_l);
    }
    lap += 1.0;
    say(0.0);
  }
  void say(double slosh) {
    estimator.receive_tank(level_l + slosh, counts_used ? used_l : kUnset, lap);
  }
};

// The paper's final: the team took an attempt of two laps with fuel for one. The figures of the
// tank are ours: 2.5 l a lap, 2 l that the pump does not reach.
TEST(Fuel, WarnsBeforeTheLastAttempt) {
  const FuelPlan plan;
  Car car{22.0};
  car.drive_lap(2.5);
  car.drive_lap(2.5);
  car.drive_lap(2.5);
  EXPECT_EQ(car.estimator.left(plan).state, FuelState::kEnough);  // 14.5 l: 5 laps, two attempts
  EXPECT_EQ(car.estimator.left(plan).attempts, 2.0);
  car.drive_lap(2.5);
  car.drive_lap(2.5);
  // 9.5 l: three laps: an attempt and home.
  EXPECT_EQ(car.estimator.left(plan).state, FuelState::kEnough);
  EXPECT_EQ(car.estimator.left(plan).attempts, 1.0);
  car.drive_lap(2.5);
  // 7 l: two laps. The attempt would end without fuel: said before it begins.
  const FuelLeft left = car.estimator.left(plan);
  EXPECT_EQ(left.state, FuelState::kNoAttempt);
  EXPECT_EQ(left.attempts, 0.0);
  EXPECT_NEAR(left.laps, 2.0, 0.01);
  EXPECT_TRUE(left.measured);
}

// Whatever is burnt: who starts an attempt that is called possible finishes it, and comes home.
TEST(Fuel, AnAttemptThatIsPossibleEndsInThePits) {
  for (double burn = 1.5; burn < 4.0; burn += 0.13) {
    Car car{40.0};
    const FuelPlan plan{.guess_l_per_lap = 4.0};
    car.drive_lap(burn);
    while (car.estimator.left(plan).attempts >= 1.0) {
      const double before = car.level_l;
      car.drive_lap(burn);
      car.drive_lap(burn);
      EXPECT_GE(before - 2.0 * burn, plan.reserve_l + burn - 1e-9) << burn;
    }
  }
}

TEST(Fuel, TheThirstiestOfTheLastLapsCounts) {
  Car car{60.0};
  for (const double burn : {2.0, 2.0, 3.0, 2.0}) car.drive_lap(burn);
  EXPECT_NEAR(car.estimator.left({}).per_lap_l, 3.0, 1e-9);
  car.drive_lap(2.0);
  car.drive_lap(2.0);
  EXPECT_NEAR(car.estimator.left({}).per_lap_l, 2.0, 1e-9);  // it was too long ago
}

TEST(Fuel, ALapThatWasNotDrivenWholeDoesNotCount) {
  FuelEstimator estimator;
  estimator.receive_tank(30.0, 10.0, 5.0);  // heard for the first time somewhere in lap 5
  estimator.receive_tank(29.9, 10.1, 6.0);
  EXPECT_FALSE(estimator.left({}).measured);
  estimator.receive_tank(27.0, 13.0, 8.0);  // lap 7 was never received
  EXPECT_FALSE(estimator.left({}).measured);
}

TEST(Fuel, FillingTheTankForgetsNoLap) {
  Car car{20.0};
  car.counts_used = false;
  car.drive_lap(2.0);
  car.drive_lap(2.0);
  car.level_l = 40.0;
  car.say(0.0);
  EXPECT_NEAR(car.estimator.left({}).per_lap_l, 2.0, 1e-9);
  EXPECT_NEAR(car.estimator.left({}).laps, 19.0, 1e-9);
  car.drive_lap(2.0);
  EXPECT_NEAR(car.estimator.left({}).per_lap_l, 2.0, 1e-9);
}

TEST(Fuel, ASloshingTankIsNoFilling) {
  Car car{30.0};
  car.counts_used = false;
  car.slosh_l = 0.8;
  for (int i = 0; i < 4; ++i) car.drive_lap(2.0);
  EXPECT_NEAR(car.estimator.left({}).per_lap_l, 2.0, 1.0);
  EXPECT_TRUE(car.estimator.left({}).measured);
}

TEST(Fuel, NothingHeardNothingKnown) {
  FuelEstimator estimator;
  EXPECT_EQ(estimator.left({}).state, FuelState::kUnknown);
  EXPECT_TRUE(std::isnan(estimator.left({}).laps));
  estimator.receive_tank(kUnset, 1.0, 1.0);
  EXPECT_EQ(estimator.left({}).state, FuelState::kUnknown);
  estimator.receive_tank(30.0, kUnset, kUnset);
  EXPECT_FALSE(estimator.left({}).measured);  // by the plan's guess
  EXPECT_EQ(estimator.left({}).state, FuelState::kEnough);
}

static_assert(std::is_trivially_copyable_v<FuelEstimator>, "part of the car's state");

constexpr Instant kBegin{seconds(100).ns};
constexpr EngineSample kFast{.speed_rpm = 6'000, .throttle = 0.7, .running = true};

// A car whose tank nobody measures, at one engine speed: as many litres as its engine samples say.
struct Unmeasured {
  FuelEstimator estimator;
  Instant now = kBegin;
  double lap = 0.0;

  Unmeasured() { estimator.receive_engine(kFast, now, lap); }
  void drive_lap(double litres) {
    const double lap_s = litres / fuel_flow_lps(kFast);
    for (int i = 0; i < 50; ++i) {
      now += from_seconds(lap_s / 50.0);
      estimator.receive_engine(kFast, now, lap);
    }
    estimator.receive_engine(kFast, now, ++lap);
  }
};

TEST(EnteredFuel, WhatNobodyHasEnteredNobodyKnows) {
  Unmeasured car;
  car.drive_lap(1.0);
  car.drive_lap(1.0);
  const FuelLeft left = car.estimator.left({});
  EXPECT_EQ(left.state, FuelState::kUnknown);
  EXPECT_TRUE(std::isnan(left.level_l + left.least_laps));
  car.estimator.enter(kUnset);
  EXPECT_EQ(car.estimator.left({}).state, FuelState::kUnknown);
}

TEST(EnteredFuel, WhatIsUsedAfterTheEntryLeavesTheTankAndNoMore) {
  Unmeasured car;
  car.drive_lap(3.0);
  car.estimator.enter(20.0);
  EXPECT_EQ(car.estimator.left({}).level_l, 20.0) << "what was burnt before was not in it";
  car.drive_lap(3.0);
  EXPECT_NEAR(car.estimator.left({}).level_l, 17.0, 1e-6);
  EXPECT_TRUE(car.estimator.left({}).estimated);
  car.drive_lap(30.0);
  EXPECT_EQ(car.estimator.left({}).level_l, 0.0);
  car.estimator.enter(30.0, 4.0);
  EXPECT_EQ(car.estimator.left({}).level_l, 26.0) << "an entry of before, restored";
  EXPECT_NEAR(car.estimator.left({}).least_l, 26.0 - 0.13 * 4.0, 1e-9);
  car.estimator.enter(30.0, kUnset);
  EXPECT_EQ(car.estimator.left({}).level_l, 30.0);
}

// The least: all that was burnt and all that a lap will burn is by the spread more.
TEST(EnteredFuel, TheLeastGrowsApartFromWhatIsExpected) {
  const FuelPlan plan{.reserve_l = 2.0, .guess_l_per_lap = 2.0, .spread = 0.13};
  Unmeasured car;
  car.estimator.enter(30.0);
  for (int lap = 0; lap < 4; ++lap) car.drive_lap(2.5);
  const FuelLeft left = car.estimator.left(plan);
  EXPECT_NEAR(left.level_l, 20.0, 1e-6);
  EXPECT_NEAR(left.laps, 18.0 / 2.5, 1e-5);
  EXPECT_NEAR(left.least_l, 30.0 - 10.0 * 1.13, 1e-6);
  EXPECT_NEAR(left.least_laps, (30.0 - 10.0 * 1.13 - 2.0) / (2.5 * 1.13), 1e-5);
  EXPECT_EQ(left.attempts, 2.0) << "the expected laps would be for three";
}

// Laps behind a slow car are no measure of an attempt: the operator's guess counts, if it is more.
TEST(EnteredFuel, SlowLapsPromiseNoFurtherAttempt) {
  const FuelPlan plan{.reserve_l = 0.0, .guess_l_per_lap = 3.0, .spread = 0.0};
  Unmeasured car;
  car.estimator.enter(12.0);
  for (int lap = 0; lap < 3; ++lap) car.drive_lap(1.0);
  EXPECT_NEAR(car.estimator.left(plan).per_lap_l, 1.0, 1e-6);
  EXPECT_NEAR(car.estimator.left(plan).laps, 9.0, 1e-4);
  EXPECT_NEAR(car.estimator.left(plan).least_laps, 3.0, 1e-4);
}

TEST(EnteredFuel, AMeasuredTankCountsFromThenOn) {
  Unmeasured car;
  car.estimator.enter(30.0);
  car.drive_lap(2.0);
  car.estimator.receive_tank(12.0, kUnset, 1.0);
  EXPECT_EQ(car.estimator.left({}).level_l, 12.0);
  EXPECT_EQ(car.estimator.left({}).least_l, 12.0);
  EXPECT_FALSE(car.estimator.left({}).estimated);
}

}  // namespace
}  // namespace pitwall::rules
