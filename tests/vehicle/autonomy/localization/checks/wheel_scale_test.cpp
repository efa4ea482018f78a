// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/checks/wheel_scale.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::localization {
namespace {

constexpr CheckParams kParams;
constexpr double kPeriod_s = 0.01, kUnknown = 0.025;

// A wheel of a tyre that grows as hil/sensors says, with a radius that is off by `radius`.
double reported(double true_mps, double radius) {
  return true_mps * (1.0 - 3.8e-6 * (true_mps * true_mps - 900.0) + radius);
}

void drive(WheelScale& scale, double true_mps, double radius, double for_s, double accel = 0.0) {
  for (double t = 0.0; t < for_s; t += kPeriod_s)
    learn(kParams, scale, reported(true_mps, radius), true_mps, accel, kPeriod_s);
}

TEST(WheelScale, IsRightAtEverySpeedAfterItWasLearnedAtOne) {
  for (const double radius : {-0.01, 0.0, 0.004}) {
    for (const double learned_at : {25.0, 66.0}) {
      WheelScale scale;
      drive(scale, learned_at, radius, 30.0);
      for (const double v : {10.0, 30.0, 50.0, 68.0})
        EXPECT_NEAR(without_scale(kParams, scale, reported(v, radius)), v,
                    0.5 * kParams.wheel_scale_sigma * v)
            << radius << ' ' << learned_at << ' ' << v;
    }
  }
}

TEST(WheelScale, WithoutReceiversNothingIsLearnedAndNothingForgotten) {
  WheelScale scale;
  drive(scale, 60.0, 0.005, 20.0);
  const double before = scale.learned;
  for (int i = 0; i < 1'000; ++i) learn(kParams, scale, 50.0, kUnset, 0.0, kPeriod_s);
  EXPECT_EQ(scale.learned, before);
  EXPECT_EQ(scale_sigma(kParams, scale, kUnknown), kParams.wheel_scale_sigma);
}

TEST(WheelScale, WheelsThatMaySlipTeachNothing) {
  WheelScale scale;
  drive(scale, 5.0, 0.01, 10.0);
  drive(scale, 40.0, 0.01, 10.0, -8.0);
  drive(scale, 40.0, 0.01, 10.0, kUnset);
  EXPECT_EQ(scale.learned, 0.0);
  EXPECT_EQ(scale_sigma(kParams, scale, kUnknown), kUnknown);
}

TEST(WheelScale, KnowsBetterTheLongerItLearns) {
  WheelScale scale;
  double before = scale_sigma(kParams, scale, kUnknown);
  for (int i = 0; i < 12; ++i) {
    drive(scale, 50.0, 0.002, 1.0);
    const double now = scale_sigma(kParams, scale, kUnknown);
    EXPECT_LE(now, before);
    before = now;
  }
  EXPECT_EQ(before, kParams.wheel_scale_sigma);
}

TEST(WheelScale, StaysWithinItsLimitWhateverItHears) {
  WheelScale scale;
  for (const double reported_mps : {11.0, 200.0, 10.0, 1e6}) {
    for (int i = 0; i < 5'000; ++i) learn(kParams, scale, reported_mps, 60.0, 0.0, kPeriod_s);
    EXPECT_LE(std::abs(scale.learned), WheelScale::kMost);
  }
}

}  // namespace
}  // namespace pitwall::localization
