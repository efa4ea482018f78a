// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/gear.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "tests/vehicle/autonomy/control/single_track.hpp"

namespace pitwall::control {
namespace {

const GearParams kGearParams = testing::recommended().gear;

TEST(Gear, RunsThroughTheTableUpAndDown) {
  GearState state;
  Instant now{};
  for (int i = 0; i <= 8000; ++i, now += milliseconds(10)) {  // 0 to 70 m/s and back in 80 s
    const double speed = 70.0 - std::abs(70.0 - i * 0.0175);
    const GearState next = step(kGearParams, state, {.speed_mps = speed}, now);
    EXPECT_LE(std::abs(next.gear - state.gear), 1);
    if (next.gear > state.gear) {
      EXPECT_GT(speed, kGearParams.up_above_mps[state.gear - 1u]);
    }
    if (next.gear < state.gear) {
      EXPECT_LT(speed, kGearParams.down_below_mps[next.gear - 1u]);
    }
    state = next;
    if (i == 4000) {
      EXPECT_EQ(state.gear, kGears);
    }
  }
  EXPECT_EQ(state.gear, 1);
}

TEST(Gear, NoiseAtAShiftSpeedShiftsOnce) {
  GearState state;
  int shifts = 0;
  for (int i = 0; i < 2000; ++i) {
    const double speed = kGearParams.up_above_mps[0] + ((i % 2) == 0 ? 0.9 : -0.9);
    const GearState next =
        step(kGearParams, state, {.speed_mps = speed}, Instant{i * 10'000'000LL});
    shifts += next.gear != state.gear;
    state = next;
  }
  EXPECT_EQ(shifts, 1);
}

TEST(Gear, StepOfSpeedShiftsOneGearPerDwell) {
  GearState state;
  Instant last{-10'000'000'000};
  for (int i = 0; i < 1000; ++i) {
    const Instant now{i * 10'000'000LL};
    const GearState next = step(kGearParams, state, {.speed_mps = 100.0}, now);
    if (next.gear != state.gear) {
      EXPECT_EQ(next.gear, state.gear + 1);
      EXPECT_GE((now - last).seconds(), kGearParams.dwell_s);
      last = now;
    }
    state = next;
  }
  EXPECT_EQ(state.gear, kGears);
  EXPECT_EQ(step(kGearParams, state, {}, Instant{1} + seconds(100)).gear, kGears);
}

}  // namespace
}  // namespace pitwall::control
