// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/gear.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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

TEST(Gear, ATargetBelowTheShiftIsNotLeftForALittleOvershoot) {
  GearState state;
  state.gear = 2;
  const double up = kGearParams.up_above_mps[1];
  GearInputs in{.speed_mps = up + 0.5, .target_mps = up - 0.1};
  state = step(kGearParams, state, in, Instant{});
  EXPECT_EQ(state.gear, 2);
  in.speed_mps = up + kBeyond_mps + 0.1;  // whatever the target: the engine revs
  EXPECT_EQ(step(kGearParams, state, in, Instant{}).gear, 3);
  in = {.speed_mps = up + 0.5, .target_mps = up + 5.0};
  EXPECT_EQ(step(kGearParams, state, in, Instant{}).gear, 3);
}

// A gearbox that takes `lag_s` for a shift, or never does it.
struct Gearbox {
  double lag_s = 0.1;
  std::uint8_t has = 1;
  std::uint8_t asked = 1;
  Instant since{};

  GearReport at(std::uint8_t gear, Instant now) {
    if (gear != asked) asked = gear, since = now;
    if (has != asked && (now - since).seconds() >= lag_s) has = asked;
    return {.known = true, .gear = has, .shifting = false};
  }
};

TEST(Gear, WaitsForTheGearboxBeforeTheNextShift) {
  Gearbox box{.lag_s = 0.65};
  GearParams params = kGearParams;
  params.dwell_s = 0.2;
  GearState state;
  int ahead_most = 0;
  for (int i = 0; i < 1000; ++i) {
    const Instant now{i * 10'000'000LL};
    const GearReport report = box.at(state.gear, now);
    state = step(params, state, {.speed_mps = 100.0, .report = report}, now);
    ahead_most = std::max(ahead_most, state.gear - report.gear);
  }
  EXPECT_EQ(ahead_most, 1);
  EXPECT_EQ(state.gear, kGears);
  EXPECT_EQ(state.missed, 0U);
}

TEST(Gear, AMissedShiftIsCountedGivenBackAndAskedForAgain) {
  Gearbox box{.lag_s = 1e9};
  GearState state;
  int asked = 0;
  std::uint8_t last = state.gear;
  for (int i = 0; i < 500; ++i) {  // 5 s at a dwell of 0.8 s after each time-out of 0.7 s
    const Instant now{i * 10'000'000LL};
    const GearReport report = box.at(state.gear, now);
    state = step(kGearParams, state, {.speed_mps = 30.0, .report = report}, now);
    EXPECT_LE(state.gear, 2);
    asked += state.gear == 2 && last == 1;
    last = state.gear;
  }
  EXPECT_EQ(state.missed, 3U);
  EXPECT_EQ(asked, 4);
}

TEST(Gear, WithoutAReportTheSpeedDecidesAndWhoDoesNotDriveAsksForWhatThereIs) {
  GearState state;
  state.gear = 2;
  const GearReport stale{.known = false, .gear = 1, .shifting = false};
  EXPECT_EQ(step(kGearParams, state, {.speed_mps = 40.0, .report = stale}, Instant{}).gear, 3);
  const GearReport fifth{.known = true, .gear = 5, .shifting = false};
  const GearState idle =
      step(kGearParams, state, {.speed_mps = 60.0, .report = fifth, .drives = false}, Instant{});
  EXPECT_EQ(idle.gear, 5);
  EXPECT_EQ(idle.missed, 0U);
}

TEST(Gear, AReportIsReadWithItsAge) {
  world::Received<world::Powertrain> powertrain;
  EXPECT_FALSE(gear_report(powertrain, Instant{}).known);
  powertrain.received = true;
  powertrain.value.gear = 4;
  powertrain.value.gear_shift_status = 3;
  const GearReport report = gear_report(powertrain, Instant{} + milliseconds(50));
  EXPECT_TRUE(report.known);
  EXPECT_TRUE(report.shifting);
  EXPECT_EQ(report.gear, 4);
  EXPECT_FALSE(gear_report(powertrain, Instant{} + milliseconds(101)).known);
  powertrain.value.gear_shift_status = 2;
  EXPECT_FALSE(gear_report(powertrain, Instant{}).shifting) << "locked out is not shifting";
}

}  // namespace
}  // namespace pitwall::control
