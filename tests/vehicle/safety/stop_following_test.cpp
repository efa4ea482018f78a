// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/stop_following.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/random.hpp"
#include "tests/support/tick.hpp"
#include "tests/vehicle/safety/frame_gate_bench.hpp"

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

// A bicycle in steady state with a steering that lags by 80 ms and an understeer of its own; an
// automatic creep pushes it while it is slow.
struct Bicycle {
  FollowingParams params;
  FollowingState state;
  PathPose pose;
  StopKind kind = StopKind::kControlled;
  double road_rad = 0.0, understeer = 0.0002, worst_m = 0.0, hardest_rad_per_s = 0.0;
  double creep_mps2 = 0.0;
  Instant now{seconds(10).ns};

  void drive(const world::Trajectory& path) {
    for (int i = 0; i < 3000; ++i) {
      now += kTick;
      const double before = state.command.road_wheel_rad;
      const world::ActuatorCommand command = follow_stop(params, state, path, pose, kind, now);
      if (i > 0)
        hardest_rad_per_s =
            std::max(hardest_rad_per_s, std::abs(command.road_wheel_rad - before) / 0.01);
      worst_m = std::max(worst_m, std::abs(state.lateral_m));
      move(command, kTick.seconds());
    }
  }

  void move(const world::ActuatorCommand& command, double dt_s) {
    constexpr double kCreepUpTo_mps = 3.0;
    const double v = pose.speed_mps, fall = kGravity_mps2 * std::sin(state.bank_rad);
    road_rad += (command.road_wheel_rad - road_rad) * dt_s / 0.08;
    const double rate = v * (road_rad + understeer * fall) /
                        (params.stop.steering.bicycle.wheelbase_m + understeer * v * v);
    pose.yaw_rate_rad_per_s = rate;
    const double turned = rate / std::cos(state.bank_rad) * dt_s;
    pose.x_m += v * std::cos(pose.yaw_rad + 0.5 * turned) * dt_s;
    pose.y_m += v * std::sin(pose.yaw_rad + 0.5 * turned) * dt_s;
    pose.yaw_rad = wrap_pi(pose.yaw_rad + turned);
    const double push = 6.0 * command.throttle_fraction + (v < kCreepUpTo_mps ? creep_mps2 : 0.0);
    const double brake = command.brake_kpa / params.stop.brake_kpa_per_mps2;
    pose.speed_mps = std::max(0.0, v + (push - brake) * dt_s);
  }
};

Bicycle at_start(double off_m, double turned_rad, double speed_mps) {
  Bicycle b;
  b.params.stop.steering.bicycle.understeer_rad_per_mps2 = 0.0002;
  b.params.stop.grip_share = 0.9, b.params.stop.friction = 1.3;
  b.state.tyre_c = 85.0;
  b.pose = {.x_m = 0.0, .y_m = off_m, .yaw_rad = turned_rad, .speed_mps = speed_mps};
  b.state.command = {.road_wheel_rad = 0.0, .throttle_fraction = 0.0, .brake_kpa = 0.0, .gear = 5};
  return b;
}

TEST(StopFollowing, HoldsThePathOfEveryCurvatureUntilItStands) {
  for (const double k : {-1.0 / 300.0, 0.0, 1.0 / 500.0, 1.0 / 300.0})
    for (const double speed_mps : {20.0, 45.0, 65.0}) {
      Bicycle b = at_start(0.0, 0.0, speed_mps);
      b.state.command.road_wheel_rad = b.road_rad = b.params.stop.steering.bicycle.wheelbase_m * k;
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

// What a motor that does not follow is asked for: by half the bandwidth a quarter for the distance.
TEST(StopFollowing, AsksAMotorThatDoesNotFollowForLess) {
  const auto asked_rad = [](double steered_rad) {
    Bicycle b = at_start(2.0, 0.0, 50.0);
    b.state.steered_rad = steered_rad;
    const world::Trajectory path = arc(0.0, 50.0, 0.0);
    for (int i = 0; i < 500; ++i) {
      b.now += kTick;
      (void)follow_stop(b.params, b.state, path, b.pose, b.kind, b.now);
    }
    return b.state.command.road_wheel_rad - b.state.steering.unknown_rad -
           b.state.steering.trim_rad;
  };
  const double followed_rad = asked_rad(kUnset), strayed_rad = asked_rad(0.0);
  EXPECT_LT(followed_rad, 0.0);
  EXPECT_NEAR(strayed_rad / followed_rad, 0.25, 0.02);
}

// An understeer that is not that of the feed-forward is trimmed away; where driving had learned it
// before the stop there is little to trim.
TEST(StopFollowing, AnUndersteerOfItsOwnIsLearnedBeforeOrTrimmedAway) {
  for (const bool learned : {true, false}) {
    Bicycle b = at_start(0.0, 0.0, 65.0);
    b.understeer = 0.0012;
    const double k = 1.0 / 300.0;
    b.state.command.road_wheel_rad = b.road_rad = b.state.learned.commanded_rad =
        b.params.stop.steering.bicycle.wheelbase_m * k + b.understeer * 65.0 * 65.0 * k;
    b.pose.yaw_rate_rad_per_s = 65.0 * k;
    if (learned) b.state.learned.understeer_rad_per_mps2 = 0.001;
    b.drive(arc(k, 65.0, 0.0));
    EXPECT_LT(b.worst_m, 1.5) << learned;
    EXPECT_LT(std::abs(b.state.lateral_m), 0.3) << learned;
  }
}

TEST(StopFollowing, NothingStepsWhereItBegins) {
  Bicycle b = at_start(0.8, 0.01, 65.0);
  b.state.command.road_wheel_rad = 0.012;
  b.state.command.brake_kpa = 300.0;
  const world::Trajectory path = arc(0.0, 65.0, 0.0);
  const world::ActuatorCommand first = follow_stop(b.params, b.state, path, b.pose, b.kind, b.now);
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
  b.state.command.road_wheel_rad = b.params.stop.steering.bicycle.wheelbase_m * k;
  for (auto& p : path.points) p.accel_mps2 = -12.0;  // more than there is
  for (int i = 0; i < 100; ++i) {
    b.now += milliseconds(10);
    follow_stop(b.params, b.state, path, b.pose, b.kind, b.now);
  }
  const Grip grip = grip_at(b.params.stop, 60.0, k, 0.0, b.state.tyre_c);
  const double usable = b.params.stop.grip_share * grip.total_mps2;
  const double left =
      std::sqrt(std::max(0.0, usable * usable - grip.lateral_mps2 * grip.lateral_mps2));
  const double asked = b.state.command.brake_kpa / b.params.stop.brake_kpa_per_mps2;
  EXPECT_GT(asked, 0.0);
  EXPECT_LE(asked, b.params.stop.brake_share * left + 1e-9);
}

// Straight on with a speed and a deceleration that are the same everywhere.
world::Trajectory steady(double speed_mps, double decel_mps2) {
  world::Trajectory path;
  for (int i = 0; i < 20; ++i)
    (void)path.points.push({.s_m = 20.0 * i,
                            .x_m = 20.0 * i,
                            .y_m = 0.0,
                            .yaw_rad = 0.0,
                            .curvature_per_m = 0.0,
                            .bank_rad = 0.0,
                            .speed_mps = speed_mps,
                            .accel_mps2 = -decel_mps2});
  return path;
}

// The pressure that it settles at; on its way it keeps to the ramp and opens no throttle.
double settled_kpa(Bicycle& b, const world::Trajectory& path) {
  const SafeStopParams& p = b.params.stop;
  const double ramp =
      b.kind == StopKind::kEmergency ? p.emergency_ramp_kpa_per_s : p.brake_ramp_kpa_per_s;
  for (int i = 0; i < 300; ++i) {
    const world::ActuatorCommand last = b.state.command;
    b.now += kTick;
    const auto next = follow_stop(b.params, b.state, path, b.pose, b.kind, b.now);
    EXPECT_LE(next.brake_kpa - last.brake_kpa, ramp * 0.01 + 1e-9);
    EXPECT_LE(last.brake_kpa - next.brake_kpa, 2.0 * ramp * 0.01 + 1e-9);
    const double closed =
        std::max(0.0, last.throttle_fraction - p.throttle_fall_per_s * kTick.seconds());
    const double expected = next.brake_kpa > kBrakeTouched_kpa ? 0.0
                            : i > 0                            ? closed
                                                               : last.throttle_fraction;
    EXPECT_NEAR(next.throttle_fraction, expected, 1e-12) << i;
  }
  EXPECT_EQ(b.state.command.throttle_fraction, 0.0);
  return b.state.command.brake_kpa;
}

TEST(StopFollowing, PressureIsWhatThePlannedDecelerationNeedsBesideTheAir) {
  for (const double v : {10.0, 40.0, 65.0})
    for (const double decel : {0.0, 2.0, 5.0})
      for (const double too_fast_mps : {-1.5, 0.0, 1.5})
        for (const double before_kpa : {0.0, 3000.0}) {
          Bicycle b = at_start(0.0, 0.0, v);
          SafeStopParams& p = b.params.stop;
          p.drag_per_m = 0.00061, p.coast_mps2 = 0.5, p.friction = 2.0;
          b.state.command.throttle_fraction = before_kpa > 0.0 ? 0.0 : 0.7;
          b.state.command.brake_kpa = before_kpa;
          const double wanted = decel + p.speed_share_per_s * too_fast_mps;
          const double free = p.coast_mps2 + p.drag_per_m * v * v;
          EXPECT_NEAR(settled_kpa(b, steady(v - too_fast_mps, decel)),
                      std::max(wanted - free, 0.0) * p.brake_kpa_per_mps2, 1e-6);
        }
}

TEST(StopFollowing, AnEmergencyAsksForAllThatTheGripLeavesWhateverIsPlanned) {
  for (const double v : {10.0, 40.0, 65.0})
    for (const double tyre_c : {20.0, 85.0, kUnset}) {
      Bicycle b = at_start(0.0, 0.0, v);
      SafeStopParams& p = b.params.stop;
      b.kind = StopKind::kEmergency;
      b.state.tyre_c = tyre_c;
      const Grip grip = grip_at(p, v, 0.0, 0.0, tyre_c);
      const double left = p.brake_share * p.emergency_grip_share * grip.total_mps2;
      EXPECT_NEAR(settled_kpa(b, steady(v, 1.0)),
                  std::min(left, p.emergency_decel_mps2) * p.brake_kpa_per_mps2, 1e-6);
    }
}

TEST(StopFollowing, EndsWithTheBrakeHeldAndDoesNotCreep) {
  for (const double creep_mps2 : {0.0, 0.5, 1.0})
    for (const double too_fast_mps : {-4.0, 0.0, 4.0})
      for (const StopKind kind : {StopKind::kControlled, StopKind::kEmergency}) {
        Bicycle b = at_start(0.0, 0.0, 20.0 + too_fast_mps);
        b.kind = kind, b.creep_mps2 = creep_mps2;
        const world::Trajectory path = arc(0.0, 20.0, 0.0);
        int slow_ticks = 0;
        bool stood = false;
        for (int i = 0; i < 3000; ++i) {
          b.now += kTick;
          const double last_mps = b.pose.speed_mps, last_kpa = b.state.command.brake_kpa;
          b.move(follow_stop(b.params, b.state, path, b.pose, b.kind, b.now), kTick.seconds());
          stood = stood || b.pose.speed_mps == 0.0;
          slow_ticks += !stood && b.pose.speed_mps < 1.0;
          ASSERT_TRUE(last_mps >= 1.0 || b.pose.speed_mps <= last_mps);
          ASSERT_TRUE(last_mps >= b.params.stop.standstill_mps ||
                      b.state.command.brake_kpa >= std::min(last_kpa, b.params.stop.hold_kpa));
        }
        EXPECT_TRUE(stood);
        EXPECT_LT(slow_ticks, 200) << creep_mps2 << ' ' << too_fast_mps;
        EXPECT_EQ(b.pose.speed_mps, 0.0);
        EXPECT_EQ(b.state.command.brake_kpa, b.params.stop.hold_kpa);
      }
}

// What it asks for, spoken on the bus: the frame gate lets all of it pass, from the first tick on.
void expect_passes(Bicycle& b, const world::Trajectory& path, int run) {
  testing::Gate gate;
  gate.params = b.params.gate;
  gate.context.now = gate.context.command_at = b.now;
  for (int i = 0; i < 3000 && (i < 100 || b.pose.speed_mps > 0.0); ++i) {
    if (i > 0) {
      gate.wait(kTick), b.now += kTick;
      b.move(follow_stop(b.params, b.state, path, b.pose, b.kind, b.now), kTick.seconds());
      gate.context.mode = b.kind == StopKind::kEmergency ? world::Mode::kEmergencyStop
                                                         : world::Mode::kControlledStop;
    }
    gate.context.speed_mps = b.pose.speed_mps;
    const world::ActuatorCommand& c = b.state.command;
    const auto out =
        gate.all({testing::brake(c.brake_kpa, i), testing::throttle(100.0 * c.throttle_fraction, i),
                  testing::steer(to_deg(c.road_wheel_rad) * b.params.steering_ratio, i),
                  testing::gear(c.gear)});
    ASSERT_FALSE(out.refused_now) << text_of(out.first_refusal) << ", run " << run << ", tick " << i
                                  << ", " << b.pose.speed_mps << " m/s";
  }
}

TEST(StopFollowing, TheFrameGateRefusesNothingAtAnySpeedAndFromAnywhere) {
  Random random{71};
  for (int run = 0; run < 400; ++run) {
    const double v = random.between(1.0, 80.0);
    Bicycle b = at_start(random.between(-15.0, 15.0), random.between(-0.2, 0.2), v);
    b.params.stop.brake_kpa_per_mps2 = 350.0;
    b.params.stop.friction = random.between(0.8, 1.3);
    b.params.stop.grip_share = 0.7;
    b.kind = random.one_in(2) ? StopKind::kEmergency : StopKind::kControlled;
    b.understeer = random.between(0.0, 0.0025);
    b.state.learned.understeer_rad_per_mps2 = random.between(-0.0002, 0.0023);
    b.creep_mps2 = random.between(0.0, 0.8);
    const double most_rad = stop_angle_max_rad(b.params.gate, b.params.steering_ratio, v);
    b.state.command.road_wheel_rad = b.road_rad = random.between(-most_rad, most_rad);
    if (random.one_in(2))
      b.state.command.throttle_fraction = random.between(0.0, 1.0);
    else
      b.state.command.brake_kpa = random.between(
          0.0, b.kind == StopKind::kEmergency ? 5500.0 : stop_brake_limit_kpa(b.params.gate, v));
    const double bent = std::min(1.0 / 100.0, 15.0 / (v * v));
    expect_passes(b,
                  arc(random.between(-bent, bent), std::max(v + random.between(-10.0, 10.0), 5.0),
                      random.between(-0.35, 0.35)),
                  run);
    if (HasFatalFailure()) return;
  }
}

// Who drove before may have braked harder than a controlled stop may.
TEST(StopFollowing, ABrakeThatWasHarderThanAStopMayComesDownFromTheFirstTickOn) {
  for (const double v : {10.0, 30.0, 60.0}) {
    Bicycle b = at_start(0.0, 0.0, v);
    b.state.command.brake_kpa = 5500.0;
    expect_passes(b, arc(0.0, v, 0.0), 0);
  }
}

TEST(StopFollowing, LeftAndRightAreMirrorImages) {
  for (const double k : {0.0, 1.0 / 400.0})
    for (const StopKind kind : {StopKind::kControlled, StopKind::kEmergency}) {
      Bicycle left = at_start(1.5, 0.02, 60.0), right = at_start(-1.5, -0.02, 60.0);
      left.kind = right.kind = kind;
      left.state.learned.commanded_rad = 0.01, right.state.learned.commanded_rad = -0.01;
      left.state.learned.offset_rad = 0.003, right.state.learned.offset_rad = -0.003;
      left.state.learned.understeer_rad_per_mps2 = 0.0008;
      right.state.learned.understeer_rad_per_mps2 = 0.0008;
      left.state.command.road_wheel_rad = 0.011, right.state.command.road_wheel_rad = -0.011;
      const auto left_path = arc(k, 60.0, 0.1), right_path = arc(-k, 60.0, -0.1);
      for (int i = 0; i < 1500; ++i) {
        left.now += kTick, right.now += kTick;
        const auto a = follow_stop(left.params, left.state, left_path, left.pose, kind, left.now);
        const auto b =
            follow_stop(right.params, right.state, right_path, right.pose, kind, right.now);
        ASSERT_NEAR(a.road_wheel_rad, -b.road_wheel_rad, 1e-12) << i;
        ASSERT_NEAR(a.brake_kpa, b.brake_kpa, 1e-6) << i;
        left.move(a, kTick.seconds()), right.move(b, kTick.seconds());
      }
    }
}

}  // namespace
}  // namespace pitwall::safety
