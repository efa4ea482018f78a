// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/dynamics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::plant {
namespace {

State rolling_at(double speed_mps) {
  const Params p;
  return rolling(p, standing(p, 0, 0, 0), speed_mps, 0);
}

TEST(Dynamics, RestIsAnEquilibrium) {
  const Params p;
  const State s = standing(p, 0, 0, 0);
  const Motion d = derivative_of(p, s, s.motion, {}, {});
  EXPECT_EQ(d.vx_mps, 0.0);
  EXPECT_EQ(d.vy_mps, 0.0);
  EXPECT_EQ(d.yaw_rate_rad_per_s, 0.0);
  EXPECT_EQ(d.wheel_rad_per_s[0], 0.0);
}

TEST(Dynamics, CoastingCarFeelsDragAndNothingElse) {
  const Params p;
  const State s = rolling_at(70.0);
  const Forces f = forces_of(p, s, s.motion, {});
  EXPECT_NEAR(f.body_x_n, -0.5 * p.aero.air_density_kgpm3 * p.aero.drag_area_m2 * 4900.0, 1e-9);
  EXPECT_EQ(f.body_y_n, 0.0);
  EXPECT_EQ(f.yaw_moment_nm, 0.0);
}

// Force on the tyre and the torque on its wheel are one: what the road gains the wheel loses.
TEST(Dynamics, PatchForceActsOnCarAndWheel) {
  const Params p;
  State s = rolling_at(50.0);
  s.motion.stretch_long_m.fill(-0.002);
  const Forces f = forces_of(p, s, s.motion, {});
  const Motion d = derivative_of(p, s, s.motion, {}, {});
  for (std::size_t i = 0; i < world::kCorners; ++i) {
    const Tyre& tyre = tyre_of(p, i);
    EXPECT_LT(f.long_n[i], 0.0);
    EXPECT_NEAR(d.wheel_rad_per_s[i] * tyre.wheel_inertia_kgm2,
                -f.long_n[i] * tyre.radius_m - f.hold_nm[i], 1e-9);
  }
}

TEST(Dynamics, PullOnTheRightTurnsLeft) {
  const Params p;
  for (const std::size_t wheel : {std::size_t{1}, std::size_t{3}}) {
    State s = rolling_at(30.0);
    s.motion.stretch_long_m[wheel] = 0.002;
    const Forces f = forces_of(p, s, s.motion, {});
    const double half_m = 0.5 * (wheel == 1 ? p.chassis.track_front_m : p.chassis.track_rear_m);
    EXPECT_GT(f.long_n[wheel], 0.0);
    EXPECT_NEAR(f.yaw_moment_nm, f.long_n[wheel] * half_m, 1e-9);
  }
}

TEST(Dynamics, SideForceInFrontTurnsTowardsIt) {
  const Params p;
  for (const bool front : {true, false}) {
    State s = rolling_at(30.0);
    const std::size_t first = front ? 0 : 2;
    s.motion.stretch_lat_m[first] = s.motion.stretch_lat_m[first + 1] = 0.002;
    const Forces f = forces_of(p, s, s.motion, {});
    const double arm_m = front ? p.chassis.front_axle_m : -p.chassis.rear_axle_m;
    EXPECT_GT(f.body_y_n, 0.0);
    EXPECT_NEAR(f.yaw_moment_nm, f.body_y_n * arm_m, 1e-9);
  }
}

TEST(Dynamics, DifferentialSlowsTheFasterWheel) {
  const Params p;
  State s = rolling_at(30.0);
  s.motion.wheel_rad_per_s[2] += 2.0;
  const Forces f = forces_of(p, s, s.motion, {});
  EXPECT_LT(f.drive_nm[2], 0.0);
  EXPECT_EQ(f.drive_nm[2], -f.drive_nm[3]);
}

TEST(Dynamics, LoadsShiftToTheRearAndToTheOutside) {
  const Params p;
  State s = rolling_at(30.0);
  s.motion.load_ax_mps2 = 5.0;
  const Forces gas = forces_of(p, s, s.motion, {});
  s.motion.load_ax_mps2 = 0.0, s.motion.load_ay_mps2 = 8.0;
  const Forces left = forces_of(p, s, s.motion, {});
  const double wheelbase_m = p.chassis.front_axle_m + p.chassis.rear_axle_m;
  const double shifted_n = 790.0 * 5.0 * p.chassis.height_m / wheelbase_m;
  EXPECT_NEAR((gas.load_n[2] + gas.load_n[3]) - (left.load_n[2] + left.load_n[3]), shifted_n, 1e-6);
  // Roll moment about the ground is carried by the two axles.
  const double moment_nm = 0.5 * (left.load_n[1] - left.load_n[0]) * p.chassis.track_front_m +
                           0.5 * (left.load_n[3] - left.load_n[2]) * p.chassis.track_rear_m;
  EXPECT_NEAR(moment_nm, 790.0 * 8.0 * p.chassis.height_m, 1e-6);
}

// Drag and downforce know the air, not the road: the wind along the car adds to its speed.
TEST(Dynamics, WindAlongTheCarIsSpeedThroughTheAir) {
  const Params p;
  for (const double yaw_rad : {0.0, 1.2, -2.5})
    for (const double head_mps : {-20.0, 7.0, 20.0}) {
      State s = rolling_at(50.0);
      s.motion.yaw_rad = yaw_rad;
      const Surface windy{.wind_east_mps = -head_mps * std::cos(yaw_rad),
                          .wind_north_mps = -head_mps * std::sin(yaw_rad)};
      const Forces f = forces_of(p, s, s.motion, windy);
      const Forces still = forces_of(p, s, rolling_at(50.0 + head_mps).motion, {});
      EXPECT_NEAR(
          f.body_x_n,
          -0.5 * p.aero.air_density_kgpm3 * p.aero.drag_area_m2 * std::pow(50.0 + head_mps, 2),
          1e-9);
      EXPECT_NEAR(f.body_y_n, 0.0, 1e-9);
      for (std::size_t i = 0; i < world::kCorners; ++i)
        EXPECT_NEAR(f.load_n[i], still.load_n[i], 1e-9);
    }
}

TEST(Dynamics, WindFromTheRightPushesToTheLeftAndFallsWithTheBank) {
  Params p;
  p.aero.side_arm_m = -0.4;
  const State s = rolling_at(60.0);
  const Forces level = forces_of(p, s, s.motion, {.wind_north_mps = 8.0});
  const double side_n =
      0.5 * p.aero.air_density_kgpm3 * p.aero.side_area_m2 * std::hypot(60.0, 8.0) * 8.0;
  EXPECT_NEAR(level.body_y_n, side_n, 1e-9);
  EXPECT_NEAR(level.yaw_moment_nm, -0.4 * side_n, 1e-9);
  const Forces banked = forces_of(p, s, s.motion, {.bank_rad = 0.3, .wind_north_mps = 8.0});
  EXPECT_LT(banked.body_y_n, level.body_y_n);
  EXPECT_GT(banked.body_y_n, 0.9 * level.body_y_n);
  // Standing across the wind the car is pushed as well.
  const State still = rolling_at(0.0);
  EXPECT_GT(forces_of(p, still, still.motion, {.wind_north_mps = 8.0}).body_y_n, 0.0);
}

TEST(Dynamics, SlipStaysBoundedWhateverTurnsOrStands) {
  const Params p;
  for (const double speed_mps : {0.0, 1e-6, 0.5, 60.0})
    for (const double wheel : {-50.0, 0.0, 1e-9, 200.0})
      for (const double vy_mps : {0.0, 1e-7, 8.0}) {
        State s = rolling_at(speed_mps);
        s.motion.vy_mps = vy_mps;
        s.motion.wheel_rad_per_s.fill(wheel);
        s.locked = {};
        // Where the patch has settled: derivative zero at slip = slip speed / reference speed.
        const Motion d = derivative_of(p, s, s.motion, {}, {});
        for (std::size_t i = 0; i < world::kCorners; ++i) {
          const double tread_mps = wheel * tyre_of(p, i).radius_m;
          const double reference_mps =
              std::sqrt(0.5 * (speed_mps * speed_mps + tread_mps * tread_mps) + vy_mps * vy_mps);
          EXPECT_LE(std::abs(d.stretch_long_m[i]), 2.0 * reference_mps + 1e-12);
          EXPECT_LE(std::abs(d.stretch_lat_m[i]), reference_mps + 1e-12);
        }
      }
}

}  // namespace
}  // namespace pitwall::plant
