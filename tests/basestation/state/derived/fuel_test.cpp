// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/fuel.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::state {
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
  void say(double slosh) { estimator.receive(level_l + slosh, counts_used ? used_l : kUnset, lap); }
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
  estimator.receive(30.0, 10.0, 5.0);  // heard for the first time somewhere in lap 5
  estimator.receive(29.9, 10.1, 6.0);
  EXPECT_FALSE(estimator.left({}).measured);
  estimator.receive(27.0, 13.0, 8.0);  // lap 7 was never received
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
  estimator.receive(kUnset, 1.0, 1.0);
  EXPECT_EQ(estimator.left({}).state, FuelState::kUnknown);
  estimator.receive(30.0, kUnset, kUnset);
  EXPECT_FALSE(estimator.left({}).measured);  // by the plan's guess
  EXPECT_EQ(estimator.left({}).state, FuelState::kEnough);
}

}  // namespace
}  // namespace pitwall::state
