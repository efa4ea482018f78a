// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/longitudinal.hpp"

#include <gtest/gtest.h>

#include "tests/vehicle/autonomy/control/single_track.hpp"

namespace pitwall::control {
namespace {

const LongitudinalParams kLongitudinalParams = testing::recommended().longitudinal;

// Long enough for every rate limit to be done.
LongitudinalOutput settled(double target, double speed) {
  return step(kLongitudinalParams, {}, target, speed, seconds(10));
}

TEST(Longitudinal, CommandIsSplitByItsSignNeverBoth) {
  for (double target = 0.0; target <= 70.0; target += 3.5) {
    for (double speed = 0.0; speed <= 70.0; speed += 3.5) {
      const auto out = settled(target, speed);
      const double c = kLongitudinalParams.kp_per_mps * (target - speed) +
                       kLongitudinalParams.feedforward_per_mps * target;
      EXPECT_NEAR(out.raw_command, c, 1e-12);
      EXPECT_EQ(out.next.throttle_fraction * out.next.brake_kpa, 0.0);
      if (target == 0.0 && speed == 0.0) continue;  // held
      EXPECT_NEAR(out.next.throttle_fraction, std::clamp(c, 0.0, 1.0), 1e-12);
      EXPECT_NEAR(out.next.brake_kpa,
                  std::clamp(-c * kLongitudinalParams.brake_kpa_per_command, 0.0,
                             kLongitudinalParams.brake_max_kpa),
                  1e-9);
    }
  }
}

TEST(Longitudinal, RatesAreLimitedPerSignalAndDirection) {
  LongitudinalState state;
  double target = 60.0;
  for (int i = 0; i < 400; ++i) {
    if (i == 150) target = 0.0;
    if (i == 300) target = 60.0;
    const auto out = step(kLongitudinalParams, state, target, 30.0, milliseconds(10));
    const double throttle = out.next.throttle_fraction - state.throttle_fraction;
    const double brake = out.next.brake_kpa - state.brake_kpa;
    EXPECT_LE(throttle, kLongitudinalParams.throttle_rise_per_s * 0.01 + 1e-12);
    EXPECT_GE(throttle, -kLongitudinalParams.throttle_fall_per_s * 0.01 - 1e-12);
    EXPECT_LE(brake, kLongitudinalParams.brake_rise_kpa_per_s * 0.01 + 1e-9);
    EXPECT_GE(brake, -kLongitudinalParams.brake_fall_kpa_per_s * 0.01 - 1e-9);
    state = out.next;
  }
}

TEST(Longitudinal, HoldsTheCarAtStandstillOnly) {
  EXPECT_EQ(settled(0.0, 0.0).next.brake_kpa, kLongitudinalParams.hold_brake_kpa);
  EXPECT_EQ(settled(0.5, 0.0).next.brake_kpa, 0.0);
  EXPECT_GT(settled(0.5, 0.0).next.throttle_fraction, 0.0);
}

TEST(Longitudinal, LetsGoWithoutATarget) {
  for (const auto& [target, speed] : {std::pair{kUnset, 10.0}, std::pair{10.0, kUnset}}) {
    const auto out = step(kLongitudinalParams, {0.8, 300.0}, target, speed, seconds(10));
    EXPECT_EQ(out.next.throttle_fraction, 0.0);
    EXPECT_EQ(out.next.brake_kpa, 0.0);
  }
}

}  // namespace
}  // namespace pitwall::control
