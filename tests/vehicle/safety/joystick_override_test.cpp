// The joystick in the supervisor: it makes the car slower, and does nothing else.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/safety/drive.hpp"

namespace pitwall::safety {
namespace {

using testing::Drive;
using world::Mode;

// Two cars in one state, one of them with a joystick, in every tick of a wild drive.
TEST(JoystickOverride, NeverFasterNeverSteers) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random{seed};
    Drive d;
    d.race();
    for (int i = 0; i < 500; ++i) {
      d.car.control.road_wheel_rad = random.between(-0.1, 0.1);
      d.car.control.throttle_fraction = random.between(0.0, 1.0);
      d.car.control.brake_kpa = random.one_in(3) ? random.between(0.0, 3000.0) : 0.0;
      d.car.ego.ay_mps2 = random.between(-20.0, 20.0);
      if (random.one_in(100)) d.car.requests.stop = true;
      if (random.one_in(200)) d.car.requests.emergency_stop = true;
      Drive free = d;
      free.car.radio = {};
      d.car.radio.throttle_cap = random.between(0.0, 1.0);
      d.car.radio.brake = random.one_in(2) ? random.between(0.0, 1.0) : 0.0;
      const SupervisorOutput with = d.tick();
      const SupervisorOutput without = free.tick();
      ASSERT_LE(with.command.throttle_fraction, without.command.throttle_fraction);
      ASSERT_GE(with.command.brake_kpa, without.command.brake_kpa);
      ASSERT_EQ(with.command.road_wheel_rad, without.command.road_wheel_rad);
      ASSERT_EQ(with.mode, without.mode);
      ASSERT_EQ(with.command.gear, without.command.gear);
    }
  }
}

TEST(JoystickOverride, ChangesNoFasterThanTheSlewLimitsLet) {
  Drive d;
  d.race();
  double last_kpa = d.out.command.brake_kpa, last_throttle = d.out.command.throttle_fraction;
  for (int i = 0; i < 400; ++i) {
    const bool pulled = i % 100 < 50;
    d.car.radio.brake = pulled ? 1.0 : 0.0;
    d.car.radio.throttle_cap = pulled ? 0.0 : 1.0;
    d.tick();
    const SupervisorParams& p = d.params;
    EXPECT_LE(d.out.command.brake_kpa - last_kpa, p.brake_rise_kpa_per_s * 0.01 + 1e-6);
    EXPECT_LE(last_kpa - d.out.command.brake_kpa, p.brake_fall_kpa_per_s * 0.01 + 1e-6);
    EXPECT_LE(d.out.command.throttle_fraction - last_throttle, p.throttle_rise_per_s * 0.01 + 1e-6);
    last_kpa = d.out.command.brake_kpa;
    last_throttle = d.out.command.throttle_fraction;
  }
}

// Pulled to its end in a corner it asks for no more than the tyres have left beside it.
TEST(JoystickOverride, BrakesWithinTheGripThatTheCornerLeaves) {
  const auto pressure_kpa = [](double ay_mps2) {
    Drive d;
    d.race();
    d.car.ego.ay_mps2 = ay_mps2;
    d.car.signals.tyre_temperature_c = {
        {{85.0, 85.0, 85.0, 85.0}}, Instant{} + seconds(3600), true};
    d.params.safe_stop.brake_share = 1.0, d.params.safe_stop.friction = 1.3;
    d.car.radio.brake = 1.0;
    d.run(milliseconds(500));
    return d.out.command.brake_kpa;
  };
  const SupervisorParams p;
  const double straight_kpa = p.safe_stop.decel_max_mps2 * p.safe_stop.brake_kpa_per_mps2;
  EXPECT_NEAR(pressure_kpa(0.0), straight_kpa, 1e-6);
  EXPECT_LT(pressure_kpa(10.0), straight_kpa);
  EXPECT_EQ(pressure_kpa(50.0), 0.0) << "nothing is left";
}

TEST(JoystickOverride, ALinkThatStopsTheCarIsTheBaseStationLost) {
  Drive d;
  d.race();
  d.car.radio.stop = true;
  d.tick();
  EXPECT_EQ(d.out.mode, Mode::kControlledStop);
  EXPECT_EQ(d.out.cause, Cause::kRadioLost);
  Drive deaf;
  deaf.params.faults.radio_loss_stops = false;
  deaf.race();
  deaf.car.radio.stop = true;
  deaf.tick();
  EXPECT_EQ(deaf.out.mode, Mode::kDriving) << "this car does without";
}

}  // namespace
}  // namespace pitwall::safety
