// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/checks/steer_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pitwall::localization {
namespace {

constexpr double kWheelbase_m = 2.971, kGuess = 0.0002, kPeriod_s = 0.01;

// A car that turns at `rate` with an offset and an understeer of its own.
Steering turning(double rate, double speed_mps, double fall_mps2, double offset_rad,
                 double understeer) {
  return {.wheelbase_m = kWheelbase_m,
          .understeer_rad_per_mps2 = kGuess,
          .angle_rad = offset_rad + kWheelbase_m * rate / speed_mps +
                       understeer * (speed_mps * rate - fall_mps2),
          .speed_mps = speed_mps,
          .fall_mps2 = fall_mps2};
}

// An oval: straights with little banking, ends with 20 degrees.
void drive(SteerFit& fit, double offset_rad, double understeer, double for_s) {
  for (double t = 0.0; t < for_s; t += kPeriod_s) {
    const bool end = std::fmod(t, 20.0) < 10.0;
    const double rate = end ? 0.25 : 0.0, fall = end ? 3.35 : 1.5;
    learn(fit, turning(rate, 66.0, fall, offset_rad, understeer), rate, kPeriod_s);
  }
}

TEST(SteerFit, KnowsTheRateOfAnotherCarAtSpeedsWhereItDidNotLearn) {
  for (const double offset_rad : {-0.003, 0.0, 0.002}) {
    for (const double understeer : {-0.0002, 0.0001, 0.0008}) {
      SteerFit fit;
      drive(fit, offset_rad, understeer, 30.0);
      for (const double v_mps : {15.0, 40.0, 68.0}) {
        const Steering at = turning(v_mps / 250.0, v_mps, 3.35, offset_rad, understeer);
        EXPECT_NEAR(yaw_rate_by(fit, at), v_mps / 250.0, 0.003 * v_mps / 250.0);
      }
    }
  }
}

TEST(SteerFit, BeforeItLearnedTheCarIsThatOfTheFile) {
  const Steering at = turning(0.2, 60.0, 3.0, 0.0, kGuess);
  EXPECT_NEAR(yaw_rate_by({}, at), 0.2, 1e-12);
}

TEST(SteerFit, AStraightAloneTellsTheOffset) {
  SteerFit fit;
  for (int i = 0; i < 3000; ++i) learn(fit, turning(0.0, 60.0, 0.0, 0.002, 0.0008), 0.0, kPeriod_s);
  EXPECT_NEAR(fit.offset_rad, 0.002, 1e-5);
  EXPECT_EQ(fit.understeer, 0.0);
}

TEST(SteerFit, ASlowCarAndBrokenFiguresTeachNothing) {
  SteerFit fit;
  learn(fit, turning(0.1, 9.0, 0.0, 0.1, 0.0), 0.1, kPeriod_s);
  learn(fit, turning(0.1, 60.0, 0.0, 0.1, 0.0), std::numeric_limits<double>::quiet_NaN(),
        kPeriod_s);
  learn(fit, turning(0.1, 60.0, 0.0, 0.1, 0.0), 0.1, 0.0);
  EXPECT_EQ(fit.offset_rad, 0.0);
  EXPECT_EQ(fit.sum_1, 0.0);
}

}  // namespace
}  // namespace pitwall::localization
