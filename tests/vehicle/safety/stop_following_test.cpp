// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/stop_following.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/tick.hpp"

namespace pitwall::safety {
namespace {

constexpr double kDecel_mps2 = 5.0;

world::Trajectory arc(double curvature_per_m, double speed_mps, double bank_rad) {
  world::Trajectory stop;
  const double length_m = speed_mps * speed_mps / (2.0 * kDecel_mps2) + 40.0;
  for (std::size_t i = 0; i < world::kTrajectoryPoints; ++i) {
    const double s_m = length_m * static_cast<double>(i) / (world::kTrajectoryPoints - 1);
    const double turned = curvature_per_m * s_m;
    const bool bent = curvature_per_m != 0.0;
    const double v2 = speed_mps * speed_mps - 2.0 * kDecel_mps2 * s_m;
    (void)stop.points.push({.s_m = s_m,
                            .x_m = bent ? std::sin(turned) / curvature_per_m : s_m,
                            .y_m = bent ? (1.0 - std::cos(turned)) / curvature_per_m : 0.0,
                            .yaw_rad = wrap_pi(turned),
                            .curvature_per_m = curvature_per_m,
                            .bank_rad = bank_rad,
                            .speed_mps = std::sqrt(std::max(0.0, v2)),
                            .accel_mps2 = v2 > 0.0 ? -kDecel_mps2 : 0.0});
  }
  return stop;
}

// A bicycle in steady state with a steering that lags by 80 ms and an understeer of its own.
struct Bicycle {
  FollowingParams params;
  FollowingState state;
  PathPose pose;
  double road_rad = 0.0, understeer = 0.0002, worst_m = 0.0, hardest_rad_per_s = 0.0;
  Instant now{seconds(10).ns};

  void drive(const world::Trajectory& path) {
    for (int i = 0; i < 3000; ++i) {
      now += kTick;
      const double before = state.command.road_wheel_rad;
      const world::ActuatorCommand command = follow_stop(params, state, path, pose, now);
      if (i > 0)
        hardest_rad_per_s =
            std::max(hardest_rad_per_s, std::abs(command.road_wheel_rad - before) / 0.01);
      worst_m = std::max(worst_m, std::abs(state.lateral_m));
      move(command, kTick.seconds());
    }
  }

 private:
  void move(const world::ActuatorCommand& command, double dt_s) {
    const double v = pose.speed_mps, fall = kGravity_mps2 * std::sin(state.bank_rad);
    road_rad += (command.road_wheel_rad - road_rad) * dt_s / 0.08;
    const double rate =
        v * (road_rad + understeer * fall) / (params.stop.wheelbase_m + understeer * v * v);
    pose.x_m += v * std::cos(pose.yaw_rad + 0.5 * rate * dt_s) * dt_s;
    pose.y_m += v * std::sin(pose.yaw_rad + 0.5 * rate * dt_s) * dt_s;
    pose.yaw_rad = wrap_pi(pose.yaw_rad + rate * dt_s);
    pose.speed_mps = std::max(0.0, v - command.brake_kpa / 250.0 * dt_s);
  }
};

Bicycle at_start(double off_m, double turned_rad, double speed_mps) {
  Bicycle b;
  b.params.stop.understeer_rad_per_mps2 = 0.0002;
  b.params.stop.grip_share = 0.9;
  b.state.tyre_c = 85.0;
  b.pose = {.x_m = 0.0, .y_m = off_m, .yaw_rad = turned_rad, .speed_mps = speed_mps};
  b.state.command = {.road_wheel_rad = 0.0, .throttle_fraction = 0.0, .brake_kpa = 0.0, .gear = 5};
  return b;
}

TEST(StopFollowing, HoldsThePathOfEveryCurvatureUntilItStands) {
  for (const double k : {-1.0 / 300.0, 0.0, 1.0 / 500.0, 1.0 / 300.0})
    for (const double speed_mps : {20.0, 45.0, 65.0}) {
      Bicycle b = at_start(0.0, 0.0, speed_mps);
      b.state.command.road_wheel_rad = b.road_rad = b.params.stop.wheelbase_m * k;
      b.drive(arc(k, speed_mps, k > 0.0 ? 0.2 : 0.0));
      EXPECT_LT(b.worst_m, 1.0) << k << " " << speed_mps;
      EXPECT_LT(std::abs(b.state.lateral_m), 0.3) << k << " " << speed_mps;
      EXPECT_LT(b.pose.speed_mps, 0.1) << k << " " << speed_mps;
      EXPECT_DOUBLE_EQ(b.state.command.brake_kpa, b.params.stop.hold_kpa);
      EXPECT_EQ(b.state.command.throttle_fraction, 0.0);
      EXPECT_EQ(b.state.command.gear, 5);
    }
}

TEST(StopFollowing, ComesBackToThePathFromBesideIt) {
  for (const double off_m : {-2.0, 2.0}) {
    Bicycle b = at_start(off_m, 0.0, 65.0);
    b.drive(arc(0.0, 65.0, 0.0));
    EXPECT_LT(b.worst_m, 2.5) << off_m;
    EXPECT_LT(std::abs(b.state.lateral_m), 0.3) << off_m;
  }
}

TEST(StopFollowing, AnUndersteerThatIsNotThatOfTheFeedForwardIsTrimmedAway) {
  Bicycle b = at_start(0.0, 0.0, 65.0);
  b.understeer = 0.0012;
  const double k = 1.0 / 300.0;
  b.state.command.road_wheel_rad = b.road_rad =
      b.params.stop.wheelbase_m * k + b.understeer * 65.0 * 65.0 * k;
  b.drive(arc(k, 65.0, 0.0));
  EXPECT_LT(b.worst_m, 1.5);
  EXPECT_LT(std::abs(b.state.lateral_m), 0.3);
}

TEST(StopFollowing, NothingStepsWhereItBegins) {
  Bicycle b = at_start(0.8, 0.01, 65.0);
  b.state.command.road_wheel_rad = 0.012;
  b.state.command.brake_kpa = 300.0;
  const world::Trajectory path = arc(0.0, 65.0, 0.0);
  const world::ActuatorCommand first = follow_stop(b.params, b.state, path, b.pose, b.now);
  EXPECT_DOUBLE_EQ(first.road_wheel_rad, 0.012);
  EXPECT_DOUBLE_EQ(first.brake_kpa, 300.0);
  b.drive(path);
  EXPECT_LE(b.hardest_rad_per_s, b.params.slew_rad_per_s * 1.0001);
}

TEST(StopFollowing, MeasuresFromTheArcAndNotFromItsChords) {
  const double k = 1.0 / 100.0;
  const world::Trajectory path = arc(k, 60.0, 0.0);
  for (double s_m = 1.0; s_m < 200.0; s_m += 0.37) {
    FollowingState state;
    const PathPose pose{.x_m = std::sin(k * s_m) / k,
                        .y_m = (1.0 - std::cos(k * s_m)) / k,
                        .yaw_rad = k * s_m,
                        .speed_mps = 60.0};
    locate(state, path, pose);
    EXPECT_NEAR(state.lateral_m, 0.0, 0.01) << s_m;
    EXPECT_NEAR(state.course_rad, 0.0, 1e-3) << s_m;
    EXPECT_NEAR(state.s_m, s_m, 0.2) << s_m;
  }
}

TEST(StopFollowing, StaysWithinTheGripThatTheCornerLeaves) {
  const double k = 1.0 / 300.0;
  Bicycle b = at_start(0.0, 0.0, 60.0);
  world::Trajectory path = arc(k, 60.0, 0.0);
  b.state.command.road_wheel_rad = b.params.stop.wheelbase_m * k;
  for (auto& p : path.points) p.accel_mps2 = -12.0;  // more than there is
  for (int i = 0; i < 100; ++i) {
    b.now += milliseconds(10);
    follow_stop(b.params, b.state, path, b.pose, b.now);
  }
  const Grip grip = grip_at(b.params.stop, 60.0, k, 0.0, b.state.tyre_c);
  const double usable = b.params.stop.grip_share * grip.total_mps2;
  const double left =
      std::sqrt(std::max(0.0, usable * usable - grip.lateral_mps2 * grip.lateral_mps2));
  const double asked = b.state.command.brake_kpa / b.params.stop.brake_kpa_per_mps2;
  EXPECT_LE(asked, std::max(b.params.stop.brake_share * left, b.params.stop.decel_min_mps2) + 1e-9);
}

}  // namespace
}  // namespace pitwall::safety
