// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/powertrain.hpp"

#include <gtest/gtest.h>

#include <array>

#include "hil/plant/dynamics.hpp"
#include "hil/plant/engine.hpp"
#include "tests/hil/plant/rolling_car.hpp"
#include "tests/hil/plant/step.hpp"

namespace pitwall::plant {
namespace {

Actuation ask(std::uint8_t gear, double throttle = 0.0) {
  return {.throttle_fraction = throttle, .gear = gear, .ignition = true};
}

TEST(Gearbox, ShiftCutsTorqueThenLocksOut) {
  const Params p;
  State s = rolling_car(40.0, 3);
  std::array<int, 5> milliseconds_in{};
  for (int i = 0; i < 1000; ++i) {
    advance_powertrain(p, ask(4), kStep_s, s);
    const Truth t = observe(p, s, {});
    ++milliseconds_in[t.gear_shift_status];
    if (t.gear_shift_status == 3) {
      EXPECT_EQ(t.gear, 3);
      EXPECT_EQ(total_ratio(p.drivetrain, s), 0.0);
    }
  }
  EXPECT_EQ(s.gear, 4);
  EXPECT_NEAR(milliseconds_in[3], 1e3 * p.drivetrain.shift_s, 2);
  EXPECT_NEAR(milliseconds_in[2], 1e3 * p.drivetrain.lockout_s, 2);
  EXPECT_EQ(milliseconds_in[0] + milliseconds_in[4], 0);
}

TEST(Gearbox, GoesOneStepAtATime) {
  const Params p;
  State s = rolling_car(30.0, 2);
  std::uint8_t before = s.gear;
  for (int i = 0; i < 5000; ++i) {
    advance_powertrain(p, ask(200), kStep_s, s);
    ASSERT_LE(s.gear - before, 1);
    before = s.gear;
  }
  EXPECT_EQ(s.gear, 6);
}

TEST(Gearbox, RefusesADownshiftThatWouldOverrev) {
  const Params p;
  State s = rolling_car(75.0, 6);
  for (int i = 0; i < 3000; ++i) {
    advance_powertrain(p, ask(1), kStep_s, s);
    const double rpm = to_rpm(s.motion.wheel_rad_per_s[2] * p.drivetrain.final_drive *
                              p.drivetrain.gear[s.gear - 1U]);
    ASSERT_LE(rpm, p.engine.limiter_rpm);
  }
  EXPECT_EQ(s.gear, 5);
}

TEST(Gearbox, RatiosAreThoseOfTheCar) {
  const Params p;
  EXPECT_NEAR(total_ratio(p.drivetrain, rolling_car(40.0, 1)), 8.75, 0.001);
  EXPECT_NEAR(total_ratio(p.drivetrain, rolling_car(40.0, 6)), 2.667, 0.001);
  EXPECT_EQ(total_ratio(p.drivetrain, rolling_car(40.0, 0)), 0.0);
}

TEST(Engine, StartsWhenCrankedAndStopsWithTheIgnition) {
  const Params p;
  State s = standing(p, 0, 0, 0);
  Actuation a = ask(0);
  a.starter = true;
  int started = 0;
  for (int i = 0; i < 3000; ++i) {
    advance_powertrain(p, a, kStep_s, s);
    if (s.engine_running && started == 0) started = i;
  }
  EXPECT_NEAR(started, 1e3 * p.engine.crank_s, 2);
  EXPECT_NEAR(s.engine_rpm, p.engine.idle_rpm, 5.0);
  a.ignition = false;
  for (int i = 0; i < 2000; ++i) advance_powertrain(p, a, kStep_s, s);
  EXPECT_FALSE(s.engine_running);
  EXPECT_NEAR(s.engine_rpm, 0.0, 1.0);
  a.starter = false, a.ignition = true;
  for (int i = 0; i < 2000; ++i) advance_powertrain(p, a, kStep_s, s);
  EXPECT_FALSE(s.engine_running);  // needs the starter again
}

TEST(Engine, BurnsItsFuelAndStopsWithAnEmptyTank) {
  Params p;
  p.fuel.start_kg = 0.02;
  State s = rolling(p, standing(p, 0, 0, 0), 50.0, 4);
  s.motion.throttle_fraction = 1.0;
  double before_kg = fuel_left_kg(p.fuel, s), burnt_kg = 0.0;
  int ran = 0;
  for (int i = 0; i < 5000; ++i) {
    const Clutch clutch = clutch_of(p, s, s.motion);
    const bool was_running = s.engine_running;
    advance_powertrain(p, ask(4, 1.0), kStep_s, s);
    const double left_kg = fuel_left_kg(p.fuel, s);
    if (was_running && left_kg > 0.0) {
      EXPECT_NEAR(before_kg - left_kg,
                  kStep_s * fuel_flow_kgps(p.engine, p.fuel, clutch.rpm, clutch.crank_torque_nm),
                  1e-12);
      ++ran;
    }
    burnt_kg += before_kg - left_kg;
    before_kg = left_kg;
  }
  EXPECT_GT(ran, 500);
  EXPECT_NEAR(burnt_kg, 0.02, 1e-12);
  EXPECT_EQ(before_kg, 0.0);
  EXPECT_FALSE(s.engine_running);
  Actuation a = ask(0);
  a.starter = true;
  for (int i = 0; i < 3000; ++i) advance_powertrain(p, a, kStep_s, s);
  EXPECT_FALSE(s.engine_running);  // the starter does not help
}

TEST(Clutch, SlipsBelowLaunchSpeedAndPullsOnlyForward) {
  const Params p;
  State s = rolling_car(3.0, 1);
  s.motion.throttle_fraction = 0.8;
  const Clutch slipping = clutch_of(p, s, s.motion);
  EXPECT_FALSE(slipping.engaged);
  EXPECT_DOUBLE_EQ(slipping.rpm, p.engine.launch_rpm);
  EXPECT_GT(slipping.crank_torque_nm, 100.0);
  s.motion.throttle_fraction = 0.0;
  EXPECT_EQ(clutch_of(p, s, s.motion).crank_torque_nm, 0.0);
  const State fast = rolling_car(40.0, 3);
  const Clutch coasting = clutch_of(p, fast, fast.motion);
  EXPECT_TRUE(coasting.engaged);
  EXPECT_LT(coasting.crank_torque_nm, 0.0);
}

}  // namespace
}  // namespace pitwall::plant
