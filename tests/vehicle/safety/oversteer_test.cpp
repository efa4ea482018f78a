// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/oversteer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/safety/situation.hpp"

namespace pitwall::safety {
namespace {

// A car that follows its front wheels.
OversteerInputs steady(const OversteerParams& p, double v, double road_wheel_rad) {
  return {
      .wheel_mps = {{v, v, v, v}},
      .road_wheel_rad = road_wheel_rad,
      .speed_mps = v,
      .yaw_rate_rad_per_s =
          v * road_wheel_rad / (p.bicycle.wheelbase_m + p.bicycle.understeer_rad_per_mps2 * v * v)};
}

bool fires(const OversteerParams& p, const OversteerInputs& in) {
  OversteerState state;
  oversteer(p, state, in);
  return oversteer(p, state, in) > 0.0;
}

TEST(Oversteer, TwoTicksInARowAndNoFewer) {
  const OversteerParams p;
  OversteerInputs in = steady(p, 60.0, 0.01);
  in.yaw_rate_rad_per_s += 0.3;
  OversteerState state;
  EXPECT_EQ(oversteer(p, state, in), 0.0);
  EXPECT_GT(oversteer(p, state, in), 1.0) << "within 20 ms";
  EXPECT_GT(oversteer(p, state, in), 1.0);
  EXPECT_EQ(oversteer(p, state, steady(p, 60.0, 0.01)), 0.0) << "gone in the tick it goes";
  EXPECT_EQ(oversteer(p, state, in), 0.0);
}

TEST(Oversteer, BothSidesOfEachLimitAtAnySpeed) {
  Random random{4};
  const OversteerParams p;
  for (int i = 0; i < 2'000; ++i) {
    const double v = random.between(p.speed_min_mps * 1.3, 90.0);
    const double rad = random.between(-0.05, 0.05);
    for (const double share : {0.98, 1.02}) {
      OversteerInputs yaw = steady(p, v, rad);
      yaw.yaw_rate_rad_per_s += std::copysign(share * p.yaw_excess_max_rad_per_s, rad);
      EXPECT_EQ(fires(p, yaw), share > 1.0) << v << ' ' << rad;
      OversteerInputs counter = steady(p, v, -rad);
      counter.yaw_rate_rad_per_s = std::copysign(share * p.yaw_excess_max_rad_per_s, rad);
      EXPECT_EQ(fires(p, counter), share > 1.0) << "turns against its front wheels";
      OversteerInputs spin = steady(p, v, rad);
      spin.wheel_mps.at[2] = spin.wheel_mps.at[3] = v * (1.0 + share * p.rear_spin_max);
      EXPECT_EQ(fires(p, spin), share > 1.0);
      OversteerInputs lock = steady(p, v, rad);
      lock.wheel_mps.at[2] = lock.wheel_mps.at[3] = v * (1.0 - share * p.rear_lock_max);
      EXPECT_EQ(fires(p, lock), share > 1.0);
    }
  }
}

TEST(Oversteer, UndersteerIsAnotherMatter) {
  const OversteerParams p;
  OversteerInputs in = steady(p, 60.0, 0.05);
  in.yaw_rate_rad_per_s *= 0.2;
  EXPECT_FALSE(fires(p, in));
}

// A wheel that lies, spins, locks or flies; four of them, however wrong.
TEST(Oversteer, OneWheelHasNoSay) {
  Random random{9};
  const OversteerParams p;
  for (int i = 0; i < 2'000; ++i) {
    OversteerInputs in = steady(p, random.between(30.0, 90.0), random.between(-0.03, 0.03));
    in.wheel_mps.at[2 + random.below(2)] *= random.between(0.0, 3.0);
    EXPECT_FALSE(fires(p, in));
    in = steady(p, random.between(30.0, 90.0), 0.0);
    in.wheel_mps.at[random.below(2)] *= random.between(1.0, 1.3);
    EXPECT_FALSE(fires(p, in)) << "a front wheel over a bump";
  }
}

TEST(Oversteer, ALaunchIsNone) {
  const OversteerParams p;
  for (double v = 0.0; v < p.speed_min_mps; v += 0.5) {
    OversteerInputs in = steady(p, v, 0.1);
    in.wheel_mps.at[2] = in.wheel_mps.at[3] = 3.0 * v + 5.0;
    in.yaw_rate_rad_per_s += 2.0;
    EXPECT_FALSE(fires(p, in)) << v;
  }
}

TEST(Oversteer, WhatIsNotKnownIsNotJudged) {
  const OversteerParams p;
  OversteerInputs in = steady(p, 60.0, 0.0);
  in.wheel_mps.at = {30.0, 30.0, 90.0, 90.0};
  in.yaw_rate_rad_per_s = 2.0;
  EXPECT_TRUE(fires(p, in));
  OversteerInputs blind = in;
  blind.speed_mps = kUnset;
  EXPECT_FALSE(fires(p, blind));
  blind = in;
  blind.yaw_rate_rad_per_s = kUnset;
  EXPECT_TRUE(fires(p, blind)) << "the wheels alone";
  blind.wheel_mps.at[0] = kUnset;
  EXPECT_FALSE(fires(p, blind));
  blind = in;
  blind.wheel_mps = {};
  EXPECT_TRUE(fires(p, blind)) << "the yaw rate alone";
  blind.road_wheel_rad = kUnset;
  EXPECT_FALSE(fires(p, blind));
}

}  // namespace
}  // namespace pitwall::safety
