// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/safe_stop.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/vehicle/safety/situation.hpp"

namespace pitwall::safety {
namespace {

using world::ActuatorCommand;
using world::Trajectory;

struct Path {
  double curvature_per_m = 0.0, bank_rad = 0.0, accel_mps2 = -6.0, speed_mps = 60.0;
};
Trajectory constant(const Path& p) {
  Trajectory t;
  for (int i = 0; i < 100; ++i)
    EXPECT_TRUE(t.points.push({.s_m = 4.0 * i,
                               .x_m = 4.0 * i,
                               .y_m = 0.0,
                               .yaw_rad = 0.0,
                               .curvature_per_m = p.curvature_per_m,
                               .bank_rad = p.bank_rad,
                               .speed_mps = p.speed_mps,
                               .accel_mps2 = p.accel_mps2}));
  return t;
}

ActuatorCommand good(double road_wheel_rad, double brake_kpa = 0.0) {
  return {.at = {},
          .road_wheel_rad = road_wheel_rad,
          .throttle_fraction = 0.5,
          .brake_kpa = brake_kpa,
          .gear = 5};
}

// A point mass that brakes as the pressure says, with another gain than the stop believes, and that
// air and rolling slow.
struct Car {
  FollowingParams params;
  SafeStopState state;
  Trajectory stop;
  ActuatorCommand last = good(0.02);
  StopKind kind = StopKind::kControlled;
  double speed_mps = 60.0, true_kpa_per_mps2 = 300.0;
  bool wheels = true;
  Instant now{};
  std::vector<ActuatorCommand> commands;
  std::vector<double> speeds;

  void run(Duration span) {
    for (const Instant end = now + span; now < end; now += milliseconds(10)) {
      const ActuatorCommand c =
          stop_along(params, state, {stop, last, wheels ? speed_mps : kUnset, kind}, now);
      const double free_mps2 = 0.3 + 0.0005 * speed_mps * speed_mps;
      speed_mps = std::max(0.0, speed_mps - (c.brake_kpa / true_kpa_per_mps2 + free_mps2) * 0.01);
      commands.push_back(c);
      speeds.push_back(speed_mps);
    }
  }
};

TEST(SafeStop, EveryStopEndsStandingWithTheBrakeHeldThrottleClosedAndTheGearKept) {
  Random random{5};
  for (int run = 0; run < 300; ++run) {
    Car car;
    car.kind = random.one_in(2) ? StopKind::kEmergency : StopKind::kControlled;
    car.wheels = !random.one_in(3);
    car.speed_mps = random.between(0.0, 80.0);
    car.true_kpa_per_mps2 = random.between(200.0, 350.0);
    if (!random.one_in(4))
      car.stop = constant({.curvature_per_m = random.between(-0.005, 0.005),
                           .bank_rad = random.between(0.0, 0.35),
                           .accel_mps2 = random.between(-12.0, 3.0),
                           .speed_mps = car.speed_mps});
    // What slows the car without the brake is known to whoever has no wheel speeds.
    car.params.stop.drag_per_m = 0.0005, car.params.stop.coast_mps2 = 0.3;
    car.last = good(random.between(-0.05, 0.05), random.between(0.0, 500.0));
    car.run(seconds(60));
    EXPECT_LT(car.speed_mps, 1e-9) << run;
    EXPECT_NEAR(car.commands.back().brake_kpa, car.params.stop.hold_kpa, 1e-9) << run;
    for (const ActuatorCommand& c : car.commands) {
      ASSERT_EQ(c.throttle_fraction, 0.0);
      ASSERT_EQ(c.gear, 5);
      ASSERT_TRUE(std::isfinite(c.road_wheel_rad));
      ASSERT_TRUE(c.brake_kpa >= 0.0 && c.brake_kpa <= car.params.stop.brake_max_kpa);
    }
  }
}

TEST(SafeStop, TheBrakeIsRampedAndStaysWithinTheGripBesideTheLateralForce) {
  for (const StopKind kind : {StopKind::kControlled, StopKind::kEmergency}) {
    for (double curvature = -0.01; curvature <= 0.01; curvature += 0.001) {
      for (const double bank : {0.0, 0.15, 0.35}) {
        Car car;
        car.kind = kind;
        car.speed_mps = 45.0;
        car.true_kpa_per_mps2 = car.params.stop.brake_kpa_per_mps2;
        car.stop = constant({.curvature_per_m = curvature, .bank_rad = bank, .accel_mps2 = -20.0});
        car.run(seconds(20));
        const double ramp = kind == StopKind::kControlled
                                ? car.params.stop.brake_ramp_kpa_per_s
                                : car.params.stop.emergency_ramp_kpa_per_s;
        for (std::size_t i = 1; i < car.commands.size(); ++i) {
          const double kpa = car.commands[i].brake_kpa;
          ASSERT_LE(kpa - car.commands[i - 1].brake_kpa, ramp * 0.01 + 1e-9);
          const double v = car.speeds[i - 1];
          if (v < 1.0) continue;
          // Written anew: friction circle with the normal load of a banked turn.
          const double g = 9.80665, ay = v * v * curvature * std::cos(bank) - g * std::sin(bank);
          const double load = g * std::cos(bank) + v * v * curvature * std::sin(bank) +
                              car.params.stop.downforce_per_m * v * v;
          const double mu_n = car.params.stop.friction * std::max(0.0, load);
          const double left = std::sqrt(std::max(0.0, mu_n * mu_n - ay * ay));
          const double bound = std::max(left, car.params.stop.decel_min_mps2);
          ASSERT_LE(kpa / car.params.stop.brake_kpa_per_mps2, bound + 1e-6)
              << curvature << ' ' << bank;
        }
      }
    }
  }
}

TEST(SafeStop, SteeringChangesByWhatThePathChangesAndForgetsItsOffset) {
  Car car;
  car.params.stop.steering.bicycle.understeer_rad_per_mps2 = 0.0;
  const double curvature = 0.004, bank = 0.3;
  car.stop = constant({.curvature_per_m = curvature, .bank_rad = bank});
  car.last = good(0.03);
  car.run(seconds(15));
  EXPECT_NEAR(car.commands.front().road_wheel_rad, 0.03, 1e-12) << "begins where it was";
  EXPECT_NEAR(car.commands.back().road_wheel_rad,
              curvature * std::cos(bank) * car.params.stop.steering.bicycle.wheelbase_m, 1e-6);
  for (std::size_t i = 1; i < car.commands.size(); ++i)
    EXPECT_LE(car.commands[i].road_wheel_rad, car.commands[i - 1].road_wheel_rad + 1e-12);
}

TEST(SafeStop, FollowsTheCurvatureAlongTheDistanceTravelled) {
  Car car;
  car.params.stop.steering.bicycle.understeer_rad_per_mps2 = 0.0;
  for (int i = 0; i < 100; ++i)  // straight for 100 m, then a turn
    ASSERT_TRUE(car.stop.points.push({.s_m = 4.0 * i,
                                      .x_m = 4.0 * i,
                                      .y_m = 0.0,
                                      .yaw_rad = 0.0,
                                      .curvature_per_m = i >= 25 ? 0.005 : 0.0,
                                      .bank_rad = 0.0,
                                      .speed_mps = 60.0,
                                      .accel_mps2 = -3.0}));
  car.last = good(0.0);
  car.true_kpa_per_mps2 = car.params.stop.brake_kpa_per_mps2;
  double travelled_m = 0.0;
  for (int i = 0; i < 300; ++i) {
    const double before = car.speed_mps;
    car.run(milliseconds(10));
    const double expected = travelled_m < 96.0 ? 0.0
                            : travelled_m > 101.0
                                ? 0.005 * car.params.stop.steering.bicycle.wheelbase_m
                                : kUnset;
    if (!std::isnan(expected)) {
      ASSERT_NEAR(car.commands.back().road_wheel_rad, expected, 1e-9) << travelled_m;
    }
    travelled_m += before * 0.01;
  }
  EXPECT_GT(travelled_m, 110.0);
}

TEST(SafeStop, LeftAndRightAreMirrorImages) {
  Random random{31};
  for (int run = 0; run < 50; ++run) {
    const Path path{.curvature_per_m = random.between(-0.008, 0.008),
                    .bank_rad = 0.0,
                    .accel_mps2 = random.between(-9, 0)};
    Path mirrored = path;
    mirrored.curvature_per_m = -path.curvature_per_m;
    Car left, right;
    left.stop = constant(path);
    right.stop = constant(mirrored);
    left.last = good(0.013);
    right.last = good(-0.013);
    left.run(seconds(10));
    right.run(seconds(10));
    for (std::size_t i = 0; i < left.commands.size(); ++i) {
      ASSERT_EQ(left.commands[i].road_wheel_rad, -right.commands[i].road_wheel_rad);
      ASSERT_EQ(left.commands[i].brake_kpa, right.commands[i].brake_kpa);
    }
  }
}

TEST(SafeStop, WithoutAPlanTheWheelIsHeld) {
  Car car;
  car.last = good(0.021);
  car.run(seconds(30));
  for (const ActuatorCommand& c : car.commands) EXPECT_EQ(c.road_wheel_rad, 0.021);
  EXPECT_EQ(car.speed_mps, 0.0);
}

TEST(SafeStop, ABadLastCommandIsNoReasonToSendNonsense) {
  Car car;
  car.last = {};
  car.wheels = false;
  car.stop = constant(
      {.curvature_per_m = kUnset, .bank_rad = kUnset, .accel_mps2 = kUnset, .speed_mps = kUnset});
  car.run(seconds(5));
  for (const ActuatorCommand& c : car.commands) {
    EXPECT_TRUE(std::isfinite(c.road_wheel_rad));
    EXPECT_TRUE(std::isfinite(c.brake_kpa));
  }
}

TEST(SafeStop, AnEmergencyIsNeverSofterThanAControlledStop) {
  for (double v = 5.0; v <= 75.0; v += 5.0) {
    Car soft, hard;
    soft.speed_mps = hard.speed_mps = v;
    hard.kind = StopKind::kEmergency;
    soft.stop = hard.stop = constant({.curvature_per_m = 0.002, .bank_rad = 0.1, .speed_mps = v});
    soft.run(seconds(40));
    hard.run(seconds(40));
    for (std::size_t i = 0; i < soft.speeds.size(); ++i)
      ASSERT_LE(hard.speeds[i], soft.speeds[i] + 1e-9) << v;
  }
}

TEST(SafeStop, APauseOfTheCallerDoesNotJumpAlongThePath) {
  Car car;
  car.stop = constant({.curvature_per_m = 0.001});
  car.run(seconds(1));
  const double before_m = car.state.travelled_m;
  car.now += seconds(30);
  car.run(milliseconds(10));
  EXPECT_LE(car.state.travelled_m - before_m, 0.1 * 60.0 + 1e-9);
}

}  // namespace
}  // namespace pitwall::safety
