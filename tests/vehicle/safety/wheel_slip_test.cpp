// SPDX-License-Identifier: Apache-2.0
// What over-steer and front wheels that lock do to the commands: driving, coasting, stopping.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/vehicle/safety/drive.hpp"
#include "vehicle/safety/supervisor.hpp"

namespace pitwall::safety {
namespace {

using testing::Drive;
using world::Mode;

struct OverSteer {
  Cause cause;
  void (*begin)(Drive&);
};
const std::array kOverSteers{
    OverSteer{Cause::kRearSpin,
              [](Drive& d) {
                d.wheel_factors = {1.0, 1.0, 1.2, 1.2};
              }},
    OverSteer{Cause::kRearLock,
              [](Drive& d) {
                d.wheel_factors = {1.0, 1.0, 0.7, 0.7};
              }},
    OverSteer{Cause::kYawExcess, [](Drive& d) { d.car.ego.yaw_rate_rad_per_s = 0.6; }}};

TEST(OverSteer, CutsThrottleAndBrakeInTheVeryTickAndIsNamed) {
  for (const OverSteer& c : kOverSteers) {
    for (const bool brakes : {false, true}) {
      Drive d;
      d.race();
      d.run(seconds(15));
      d.car.control.throttle_fraction = brakes ? 0.0 : 0.3;
      d.car.control.brake_kpa = brakes ? 1500.0 : 0.0;
      d.run(milliseconds(300));
      ASSERT_GT(d.speed_mps, 1.5 * d.params.faults.oversteer.speed_min_mps);
      const double before_kpa = d.out.command.brake_kpa;
      ASSERT_EQ(before_kpa, d.car.control.brake_kpa);
      const Instant slides = d.now;
      c.begin(d);
      while (d.out.mode == Mode::kDriving) {
        d.car.signals.steering_motor_rad.at = d.now;
        d.tick();
      }
      EXPECT_LE(d.now - slides, milliseconds(20)) << text_of(c.cause);
      EXPECT_EQ(d.out.mode, Mode::kCoast);
      EXPECT_EQ(d.out.command.throttle_fraction, 0.0);
      EXPECT_EQ(d.out.command.brake_kpa,
                std::max(0.0, before_kpa - 0.01 * d.params.brake_fall_kpa_per_s));
      EXPECT_TRUE(d.out.causes.has(c.cause)) << text_of(c.cause);
      EXPECT_EQ(d.state.coasts.cause, c.cause);
      EXPECT_TRUE(d.out.seen.has(world::Monitor::kOversteer));
    }
  }
}

TEST(OverSteer, ReleasesTheJoystickBrakeToo) {
  Drive d;
  d.race();
  d.run(seconds(15));
  d.car.radio.brake = 1.0;
  d.run(milliseconds(300));
  ASSERT_GT(d.out.command.brake_kpa, 500.0);
  d.wheel_factors = {1.0, 1.0, 0.7, 0.7};
  d.run(milliseconds(300));
  EXPECT_EQ(d.out.command.brake_kpa, 0.0);
  d.wheel_factors = {1.0, 1.0, 1.0, 1.0};
  d.run(milliseconds(300));
  EXPECT_GT(d.out.command.brake_kpa, 500.0) << "the car coasts, and the joystick brakes again";
}

// A stop keeps the least share of what the grip allows, whatever the wheels say.
TEST(OverSteer, InAStopLeavesTheLeastShareOfTheBrakeAndNoThrottle) {
  for (const OverSteer& c : kOverSteers) {
    Drive slides, calm;
    for (Drive* d : {&slides, &calm}) {
      d->race();
      d->run(seconds(15));
      d->car.requests.emergency_stop = true;
      d->run(milliseconds(100));
      ASSERT_EQ(d->out.mode, Mode::kEmergencyStop);
    }
    ASSERT_GT(slides.out.command.brake_kpa, 500.0);
    c.begin(slides);
    const double before_kpa = slides.out.command.brake_kpa;
    for (int tick = 0; tick < 2 && slides.out.causes.at_least(Reaction::kCoast)
                                       .without(calm.out.causes.at_least(Reaction::kCoast))
                                       .empty();
         ++tick) {
      slides.car.signals.steering_motor_rad.at = slides.now;
      slides.tick();
    }
    EXPECT_TRUE(slides.out.causes.has(c.cause)) << text_of(c.cause);
    EXPECT_EQ(slides.state.safe_stop.following.lock_share,
              slides.params.safe_stop.lock_share_least);
    EXPECT_LT(slides.out.command.brake_kpa, before_kpa) << text_of(c.cause);
    EXPECT_EQ(slides.out.command.throttle_fraction, 0.0);
    EXPECT_EQ(slides.out.mode, Mode::kEmergencyStop);
  }
}

struct FrontWheelsLock : ::testing::Test {
  Drive d;
  void SetUp() override {
    d.race();
    d.run(seconds(15));
    d.car.signals.brake = {{0.0, 0.0}, d.now, true};
    d.tick();
    d.car.control.throttle_fraction = 0.0;
    d.car.control.brake_kpa = 1500.0;
    d.run(milliseconds(200));
    ASSERT_EQ(d.out.command.brake_kpa, 1500.0);
  }
};

TEST_F(FrontWheelsLock, TakesPressureBackInTheVeryTickAndNeverMoreThanItsShare) {
  for (const auto& locked : {std::array{0.6, 0.6, 1.0, 1.0}, std::array{0.6, 1.0, 1.0, 1.0},
                             std::array{1.0, 0.0, 1.0, 1.0}}) {
    d.wheel_factors = locked;
    const double before_kpa = d.out.command.brake_kpa;
    d.tick();
    EXPECT_EQ(d.out.mode, Mode::kDriving);
    EXPECT_TRUE(d.out.causes.has(Cause::kFrontLock));
    EXPECT_LT(d.out.command.brake_kpa, before_kpa);
    d.run(milliseconds(400));
    EXPECT_EQ(d.out.command.brake_kpa, 1500.0 * d.params.safe_stop.lock_share_least);
    d.wheel_factors = {1.0, 1.0, 1.0, 1.0};
    d.tick();
    EXPECT_FALSE(d.out.causes.has(Cause::kFrontLock));
    d.car.control.brake_kpa = 0.0;
    d.run(milliseconds(100));
    d.car.control.brake_kpa = 1500.0;
    d.run(milliseconds(200));
    EXPECT_EQ(d.out.command.brake_kpa, 1500.0) << "a new braking has all of it";
  }
}

// While control asks for ever more.
TEST_F(FrontWheelsLock, ThePressureFallsFromWhatIsInUse) {
  d.wheel_factors = {0.6, 0.6, 1.0, 1.0};
  for (int tick = 0; tick < 8; ++tick) {
    d.car.control.brake_kpa += 100.0;
    const double before_kpa = d.out.command.brake_kpa;
    d.tick();
    EXPECT_LT(d.out.command.brake_kpa, before_kpa) << tick;
  }
}

TEST_F(FrontWheelsLock, ASensorThatWasWrongBeforeTheBrakeCostsNothing) {
  for (std::size_t wheel = 0; wheel < world::kCorners; ++wheel) {
    for (const double factor : {0.0, 0.5, 0.8, 1.3}) {
      d.wheel_factors = {1.0, 1.0, 1.0, 1.0};
      d.wheel_factors[wheel] = factor;
      d.car.control.brake_kpa = 0.0;
      d.run(milliseconds(100));
      d.car.signals.brake = {{0.0, 0.0}, d.now, true};
      d.tick();
      d.car.control.brake_kpa = 1500.0;
      d.car.signals.brake = {{1500.0, 1500.0}, d.now, true};
      d.run(milliseconds(200));
      EXPECT_EQ(d.out.command.brake_kpa, 1500.0) << wheel << ' ' << factor;
      EXPECT_EQ(d.out.mode, Mode::kDriving);
    }
  }
}

}  // namespace
}  // namespace pitwall::safety
