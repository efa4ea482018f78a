// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/oversteer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/safety/situation.hpp"

namespace pitwall::safety {
namespace {

constexpr world::PerWheel all_alike(double v) { return {{v, v, v, v}}; }
constexpr WheelFrames all_at(double v) { return {all_alike(v), all_alike(v)}; }
void set(WheelFrames& frames, std::size_t wheel, double v) {
  for (world::PerWheel& frame : frames) frame.at[wheel] = v;
}

// A car that follows its front wheels.
OversteerInputs steady(const OversteerParams& p, double v, double road_wheel_rad) {
  return {
      .wheel_mps = all_at(v),
      .road_wheel_rad = road_wheel_rad,
      .speed_mps = v,
      .yaw_rate_rad_per_s =
          v * road_wheel_rad / (p.bicycle.wheelbase_m + p.bicycle.understeer_rad_per_mps2 * v * v)};
}

Oversteer seen(const OversteerParams& p, const OversteerInputs& in) {
  OversteerState state;
  detect_oversteer(p, state, in);
  return detect_oversteer(p, state, in);
}
bool fires(const OversteerParams& p, const OversteerInputs& in) { return seen(p, in).any(); }

TEST(Oversteer, TheYawRateTwoTicksInARowAndNoFewer) {
  const OversteerParams p;
  OversteerInputs in = steady(p, 60.0, 0.01);
  in.yaw_rate_rad_per_s += 0.3;
  OversteerState state;
  EXPECT_FALSE(detect_oversteer(p, state, in).any());
  EXPECT_GT(detect_oversteer(p, state, in).yaw_excess, 1.0) << "within 20 ms";
  EXPECT_GT(detect_oversteer(p, state, in).yaw_excess, 1.0);
  EXPECT_FALSE(detect_oversteer(p, state, steady(p, 60.0, 0.01)).any())
      << "gone in the tick it goes";
  EXPECT_FALSE(detect_oversteer(p, state, in).any());
}

// A tick may bring no frame, one, or several.
TEST(Oversteer, TheWheelsTwoFramesInARowWhateverTheTick) {
  const OversteerParams p;
  OversteerInputs in = steady(p, 60.0, 0.01);
  const world::PerWheel spins{{60.0, 60.0, 70.0, 70.0}};
  OversteerState state;
  in.wheel_mps = {spins, all_alike(60.0)};
  for (int tick = 0; tick < 4; ++tick)
    EXPECT_FALSE(detect_oversteer(p, state, in).any())
        << "one frame, however long it is the newest";
  in.wheel_mps = {all_alike(60.0), spins};
  EXPECT_FALSE(detect_oversteer(p, state, in).any()) << "it is over";
  in.wheel_mps = {spins, spins};
  EXPECT_GT(detect_oversteer(p, state, in).rear_spin, 1.0) << "in the first tick that has both";
}

TEST(Oversteer, SaysWhichIndicatorItWas) {
  const OversteerParams p;
  for (int which = 0; which < 3; ++which) {
    OversteerInputs in = steady(p, 60.0, 0.01);
    if (which == 0) set(in.wheel_mps, 2, 70.0), set(in.wheel_mps, 3, 70.0);
    if (which == 1) set(in.wheel_mps, 2, 40.0), set(in.wheel_mps, 3, 40.0);
    if (which == 2) in.yaw_rate_rad_per_s += 0.3;
    const Oversteer found = seen(p, in);
    EXPECT_EQ(found.rear_spin > 1.0, which == 0);
    EXPECT_EQ(found.rear_lock > 1.0, which == 1);
    EXPECT_EQ(found.yaw_excess > 1.0, which == 2);
  }
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
      for (const std::size_t rear : {2u, 3u})
        set(spin.wheel_mps, rear, v * (1.0 + share * p.rear_spin_max));
      EXPECT_EQ(fires(p, spin), share > 1.0);
      OversteerInputs lock = steady(p, v, rad);
      for (const std::size_t rear : {2u, 3u})
        set(lock.wheel_mps, rear, v * (1.0 - share * p.rear_lock_max));
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
    const double v = in.wheel_mps[0].at[0];
    set(in.wheel_mps, 2 + random.below(2), v * random.between(0.0, 3.0));
    EXPECT_FALSE(fires(p, in));
    in = steady(p, v, 0.0);
    set(in.wheel_mps, random.below(2), v * random.between(1.0, 1.3));
    EXPECT_FALSE(fires(p, in)) << "a front wheel over a bump";
  }
}

TEST(Oversteer, ALaunchIsNone) {
  const OversteerParams p;
  for (double v = 0.0; v < p.speed_min_mps; v += 0.5) {
    OversteerInputs in = steady(p, v, 0.1);
    for (const std::size_t rear : {2u, 3u}) set(in.wheel_mps, rear, 3.0 * v + 5.0);
    in.yaw_rate_rad_per_s += 2.0;
    EXPECT_FALSE(fires(p, in)) << v;
  }
}

TEST(Oversteer, WhatIsNotKnownIsNotJudged) {
  const OversteerParams p;
  OversteerInputs in = steady(p, 60.0, 0.0);
  const world::PerWheel spins{{30.0, 30.0, 90.0, 90.0}};
  in.wheel_mps = {spins, spins};
  in.yaw_rate_rad_per_s = 2.0;
  EXPECT_TRUE(fires(p, in));
  OversteerInputs blind = in;
  blind.speed_mps = kUnset;
  EXPECT_FALSE(fires(p, blind));
  blind = in;
  blind.yaw_rate_rad_per_s = kUnset;
  EXPECT_TRUE(fires(p, blind)) << "the wheels alone";
  blind.wheel_mps[1].at[0] = kUnset;
  EXPECT_FALSE(fires(p, blind));
  blind = in;
  blind.wheel_mps = {};
  EXPECT_TRUE(fires(p, blind)) << "the yaw rate alone";
  blind.road_wheel_rad = kUnset;
  EXPECT_FALSE(fires(p, blind));
}

TEST(Oversteer, BothFramesMustBeYoung) {
  const Instant now = Instant{} + seconds(3);
  world::VehicleSignals signals;
  signals.wheel_speed_mps = {all_alike(40.0), now, true};
  EXPECT_TRUE(std::isnan(wheel_frames(signals, now)[0].at[0])) << "one frame are not two";
  signals.wheel_speed_before_mps = {all_alike(39.0), now - milliseconds(5), true};
  EXPECT_EQ(wheel_frames(signals, now)[0].at[0], 40.0);
  EXPECT_EQ(wheel_frames(signals, now)[1].at[0], 39.0);
  EXPECT_EQ(wheel_frames(signals, now + milliseconds(45))[1].at[0], 39.0);
  EXPECT_TRUE(std::isnan(wheel_frames(signals, now + milliseconds(46))[0].at[0]));
}

constexpr double kLockSlip = 0.1;

FrontWheelInputs braking(double fl, double fr, double rl, double rr, double speed_mps) {
  const world::PerWheel frame{{fl, fr, rl, rr}};
  return {.wheel_mps = {frame, frame},
          .speed_mps = speed_mps,
          .brake_kpa = 2000.0,
          .lock_slip = kLockSlip};
}

// After a stretch without brake on which all sensors agreed.
FrontWheelState rolled() {
  FrontWheelState state;
  FrontWheelInputs rolling = braking(40.0, 40.0, 40.0, 40.0, 40.0);
  rolling.brake_kpa = 0.0;
  EXPECT_EQ(front_slip(state, rolling), 0.0);
  return state;
}

TEST(FrontLock, SlipIsThatOfTheSlowerFrontWheelAgainstTheOthersAndTheCar) {
  struct Case {
    std::array<double, world::kCorners> mps;
    double speed_mps, slip;
  };
  for (const Case& c :
       {Case{{40.0, 40.0, 40.0, 40.0}, 40.0, 0.0}, Case{{30.0, 40.0, 40.0, 40.0}, 40.0, 0.25},
        Case{{40.0, 0.0, 40.0, 40.0}, 40.0, 1.0}, Case{{20.0, 10.0, 40.0, 40.0}, 40.0, 0.75},
        Case{{30.0, 40.0, 40.0, 40.0}, kUnset, 0.25},
        Case{{40.0, 40.0, 50.0, 50.0}, 40.0, 0.0},    // spins behind
        Case{{40.0, 40.0, 40.0, 70.0}, kUnset, 0.0},  // one sensor too fast
        Case{{40.0, 40.0, 10.0, 0.0}, 40.0, 0.0}, Case{{0.0, 0.0, 5.0, 5.0}, 5.0, 0.0}}) {
    FrontWheelState state = rolled();
    EXPECT_NEAR(front_slip(state, braking(c.mps[0], c.mps[1], c.mps[2], c.mps[3], c.speed_mps)),
                c.slip, 1e-12)
        << c.mps[0] << ' ' << c.mps[1];
  }
  for (std::size_t i = 0; i < world::kCorners; ++i) {
    FrontWheelState state = rolled();
    FrontWheelInputs bad = braking(30.0, 30.0, 40.0, 40.0, 40.0);
    bad.wheel_mps[i % 2].at[i] = kUnset;
    EXPECT_TRUE(std::isnan(front_slip(state, bad))) << i;
  }
}

TEST(FrontLock, TwoFramesInARow) {
  FrontWheelState state = rolled();
  FrontWheelInputs in = braking(30.0, 30.0, 40.0, 40.0, 40.0);
  in.wheel_mps[1] = all_alike(40.0);
  EXPECT_EQ(front_slip(state, in), 0.0);
  in.wheel_mps = {all_alike(40.0), in.wheel_mps[0]};
  EXPECT_EQ(front_slip(state, in), 0.0);
}

// Whichever wheel's sensor, whatever it says from before the brake is touched.
TEST(FrontLock, OneSensorThatWasWrongBeforeIsNoLock) {
  Random random{11};
  for (int i = 0; i < 5'000; ++i) {
    const double v = random.between(12.0, 90.0), factor = random.between(0.0, 2.0);
    const auto wrong = static_cast<std::size_t>(random.below(4));
    if (std::abs(factor - 1.0) < 0.5 * kLockSlip) continue;  // as good as right
    FrontWheelState state;
    FrontWheelInputs in = braking(v, v, v, v, v);
    set(in.wheel_mps, wrong, v * factor);
    in.brake_kpa = 0.0;
    front_slip(state, in);
    in.brake_kpa = 3000.0;
    EXPECT_LE(front_slip(state, in), kLockSlip) << wrong << ' ' << factor;
  }
}

TEST(FrontLock, AWheelNobodyHasSeenRollingCountsOnlyWithTheOther) {
  FrontWheelState state;
  EXPECT_EQ(front_slip(state, braking(30.0, 40.0, 40.0, 40.0, 40.0)), 0.0);
  EXPECT_EQ(front_slip(state, braking(30.0, 34.0, 40.0, 40.0, 40.0)), 0.25);
}

}  // namespace
}  // namespace pitwall::safety
