// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/command_choice.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/safety/drive.hpp"
#include "vehicle/safety/frame_gate.hpp"

namespace pitwall::safety {
namespace {

using testing::Drive;
using world::Mode;

TEST(CommandChoice, ACommandWithANumberMissingOrOutOfRangeIsNotUsable) {
  const world::ActuatorCommand good{
      .at = {}, .road_wheel_rad = 0.0, .throttle_fraction = 0.5, .brake_kpa = 0.0, .gear = 1};
  EXPECT_TRUE(is_usable(good));
  for (const double bad : {kUnset, HUGE_VAL, -1.0}) {
    world::ActuatorCommand c = good;
    c.throttle_fraction = bad;
    EXPECT_FALSE(is_usable(c));
    c = good;
    c.brake_kpa = bad;
    EXPECT_FALSE(is_usable(c));
  }
}

// However hard control brakes, a controlled stop stays within what the gate lets pass.
TEST(CommandChoice, AControlledStopBrakesWithinTheGripAtEverySpeed) {
  for (const double v : {5.0, 20.0, 40.0, 60.0, 75.0}) {
    for (const double before_kpa : {0.0, 5000.0}) {
      Drive d;
      d.race();
      d.car.control.throttle_fraction = 0.0;
      d.car.control.brake_kpa = before_kpa;
      d.run(milliseconds(500));
      d.car.requests.stop = true;
      d.car.control.brake_kpa = 5500.0;
      const GateParams gate;
      for (int tick = 0; tick < 60; ++tick) {
        d.speed_mps = v;
        d.car.ego.vx_mps = v;
        const double last_kpa = d.out.command.brake_kpa;
        d.tick();
        ASSERT_EQ(d.out.mode, Mode::kControlledStop);
        const double kpa = d.out.command.brake_kpa;
        ASSERT_TRUE(kpa <= stop_brake_limit_kpa(gate, v) || kpa < last_kpa) << v << ' ' << kpa;
      }
    }
  }
}

// Far beside its path a stop demands all there is; what the gate refuses, the drive-by-wire takes
// for a dead computer.
TEST(CommandChoice, AStopSteersWithinWhatTheGateLetsPassAtEverySpeed) {
  for (const double v : {5.0, 20.0, 40.0, 60.0, 75.0, 95.0}) {
    for (const double side : {-1.0, 1.0}) {
      Drive d;
      d.race();
      d.car.requests.stop = true;
      d.car.control.road_wheel_rad = side;
      d.car.ego.x_m = 0.0, d.car.ego.y_m = -300.0 * side, d.car.ego.yaw_rad = 0.0;
      d.car.ego.vy_mps = d.car.ego.yaw_rate_rad_per_s = 0.0;
      double most_deg = 0.0;
      for (int tick = 0; tick < 200; ++tick) {
        d.speed_mps = v;
        d.car.ego.vx_mps = v;
        d.tick();
        ASSERT_EQ(d.out.mode, Mode::kControlledStop);
        most_deg = side * to_deg(d.out.command.road_wheel_rad) * d.params.steering_ratio;
        const GateParams& gate = d.params.gate;
        ASSERT_LT(most_deg, gate.stop_steer_share * steer_limit_deg(gate, v)) << v;
      }
      EXPECT_GT(most_deg, 0.9 * d.params.gate.stop_steer_share * steer_limit_deg({}, v)) << v;
    }
  }
}

// Where the path cannot be held, what is left is to be slower; where it can, the stop stays smooth.
TEST(CommandChoice, AStopThatMayLeaveItsPathBrakesAsAnEmergency) {
  const auto pressure_kpa = [](bool strays, bool no_imu, bool no_position) {
    Drive d;
    d.race();
    d.car.control.brake_kpa = 0.0;
    d.run(milliseconds(500));
    d.car.requests.stop = true;
    if (no_imu)
      for (const Stream imu : {Stream::kImu0, Stream::kImu1})
        d.car.watchdog.rows[static_cast<std::size_t>(imu)].health = Health::kBad;
    if (no_position) d.car.ego.validity = world::Validity::kDeadReckoning;
    for (int tick = 0; tick < 60; ++tick) {
      d.speed_mps = d.car.ego.vx_mps = 40.0;
      const double motor_rad = d.out.command.road_wheel_rad * d.params.steering_ratio;
      d.car.signals.steering_motor_rad = {motor_rad + (strays ? 0.2 : 0.0), d.now, true};
      d.tick();
      EXPECT_EQ(d.out.mode, Mode::kControlledStop);
    }
    return d.out.command.brake_kpa;
  };
  const double smooth_kpa = pressure_kpa(false, false, false);
  EXPECT_GT(smooth_kpa, 0.0);
  EXPECT_EQ(pressure_kpa(false, true, false), smooth_kpa);
  EXPECT_EQ(pressure_kpa(false, false, true), smooth_kpa);
  EXPECT_GT(pressure_kpa(true, false, false), 1.2 * smooth_kpa);
  EXPECT_GT(pressure_kpa(false, true, true), 1.2 * smooth_kpa);
}

// Beside a twin that the operator stops, for the same path and pose.
TEST(CommandChoice, AStopSteersWithTheBiasThatTheSteeringSensorDoesNotShow) {
  constexpr double kBias_rad = 0.02;
  const auto stopped = [](bool biased) {
    Drive d;
    d.race();
    d.run(milliseconds(500));
    d.car.requests.stop = !biased;
    d.learned.innovation_rad = biased ? kBias_rad : 0.0;
    d.learned.innovation_sigma_rad = 0.001;
    for (int tick = 0; tick < 500; ++tick) {
      d.speed_mps = d.car.ego.vx_mps = 40.0;
      d.car.signals.steering_motor_rad = {d.out.command.road_wheel_rad * d.params.steering_ratio,
                                          d.now, true};
      d.tick();
      if (d.out.mode == Mode::kControlledStop) d.learned.innovation_rad = 0.001;
    }
    return d;
  };
  const Drive calm = stopped(false), biased = stopped(true);
  EXPECT_EQ(biased.out.mode, Mode::kControlledStop);
  EXPECT_EQ(biased.state.log.first.cause, Cause::kSteeringBiased);
  EXPECT_EQ(biased.state.steering_bias_rad, kBias_rad) << "that of the moment it was found";
  EXPECT_FALSE(biased.state.steering_deviated) << "its motor follows";
  EXPECT_NEAR(biased.out.command.road_wheel_rad - calm.out.command.road_wheel_rad, kBias_rad,
              0.02 * kBias_rad);
  EXPECT_GT(biased.out.command.brake_kpa, 1.2 * calm.out.command.brake_kpa);
}

// The engine goes off at any speed where, and only where, a stop's throttle stays open.
TEST(CommandChoice, AThrottleThatStaysOpenInAStopTurnsTheEngineOff) {
  for (const bool stuck : {false, true}) {
    for (const double v : {8.0, 30.0, 65.0}) {
      Drive d;
      d.race();
      d.speed_mps = d.car.ego.vx_mps = v;
      d.car.control.throttle_fraction = 0.6;
      d.car.control.brake_kpa = 0.0;
      const auto tick = [&](double throttle) {
        d.speed_mps = v;
        d.car.signals.throttle_fraction = {throttle, d.now + milliseconds(10), true};
        d.tick();
      };
      for (int i = 0; i < 100; ++i) tick(d.out.command.throttle_fraction);
      EXPECT_EQ(d.out.mode, Mode::kDriving) << safety::text_of(d.out.cause);
      EXPECT_FALSE(d.out.engine_off) << "nothing is wrong";
      d.car.requests.stop = true;
      d.car.control.throttle_fraction = 0.0;
      int ticks = 0;
      for (; ticks < 100 && !d.out.engine_off; ++ticks)
        tick(stuck ? 0.6 : d.out.command.throttle_fraction);
      EXPECT_EQ(d.out.mode, Mode::kControlledStop);
      EXPECT_EQ(d.out.engine_off, stuck) << v;
      EXPECT_LT(ticks, stuck ? 60 : 101) << "within 0.6 s";
    }
  }
}

}  // namespace
}  // namespace pitwall::safety
