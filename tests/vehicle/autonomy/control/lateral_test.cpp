// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/lateral.hpp"

#include <gtest/gtest.h>

#include "tests/support/eigenvalues.hpp"
#include "tests/vehicle/autonomy/control/single_track.hpp"
#include "vehicle/autonomy/control/bicycle_model.hpp"

namespace pitwall::control {
namespace {

using testing::recommended;

world::EgoState ego_at(double x, double y, double yaw, double vx) {
  world::EgoState ego;
  ego.validity = world::Validity::kGood;
  ego.x_m = x, ego.y_m = y, ego.yaw_rad = yaw, ego.vx_mps = vx;
  ego.vy_mps = ego.yaw_rate_rad_per_s = 0.0;
  return ego;
}

// Straight, in any direction, starting behind the origin.
world::Trajectory straight(double yaw) {
  world::Trajectory t;
  for (int i = -2; i < 100; ++i) {
    const double d = 2.0 * i;
    EXPECT_TRUE(t.points.push({.s_m = d + 4.0,
                               .x_m = d * std::cos(yaw),
                               .y_m = d * std::sin(yaw),
                               .yaw_rad = wrap_pi(yaw),
                               .curvature_per_m = 0.0,
                               .bank_rad = 0.0,
                               .speed_mps = 20.0,
                               .accel_mps2 = 0.0}));
  }
  return t;
}

TEST(Lateral, BracketsAreHalfOpen) {
  EXPECT_EQ(bracket_of(-3.0), 0u);
  for (std::size_t i = 1; i < kSpeedBrackets; ++i) {
    EXPECT_EQ(bracket_of(kBracketFrom_mps[i]), i);
    EXPECT_EQ(bracket_of(std::nextafter(kBracketFrom_mps[i], 0.0)), i - 1);
  }
  EXPECT_EQ(bracket_of(1e3), kSpeedBrackets - 1);
}

TEST(Lateral, EveryBracketStabilisesTheModelOverItsSpeeds) {
  const Params p = recommended();
  const auto gains = prepare(p);
  ASSERT_TRUE(gains) << to_string(gains.error());
  for (double v = 2.0; v < 80.0; v += 0.5) {
    const auto& k = gains->k[bracket_of(v)];
    const Eigen::RowVector4d row(k[0], k[1], k[2], k[3]);
    const Eigen::Matrix4d loop = error_dynamics(p.bicycle, v) - steering_input(p.bicycle) * row;
    EXPECT_LT(pitwall::testing::largest_real_part(pitwall::testing::numbers_of(loop)), 0.0) << v;
  }
}

TEST(Lateral, SignsDriveTheCarBackInEveryDirection) {
  const Params p = recommended();
  const auto gains = prepare(p);
  ASSERT_TRUE(gains);
  for (double yaw = -3.1; yaw < 3.2; yaw += 0.4) {
    const world::Trajectory t = straight(yaw);
    const auto steer_at = [&](double left_m, double turned_rad) {
      return steer(
          p.lateral, *gains, {},
          ego_at(-left_m * std::sin(yaw), left_m * std::cos(yaw), wrap_pi(yaw + turned_rad), 20.0),
          t);
    };
    const auto on = steer_at(0.0, 0.0), left = steer_at(0.5, 0.0), turned = steer_at(0.0, 0.05);
    EXPECT_NEAR(on.angle_rad, 0.0, 1e-9) << yaw;
    EXPECT_LT(left.angle_rad, -1e-3) << yaw;
    EXPECT_NEAR(left.e1_m, 0.5, 1e-9);
    EXPECT_NEAR(left.cross_track_m, 0.5, 1e-9);
    EXPECT_LT(turned.angle_rad, -1e-3) << yaw;
    EXPECT_NEAR(turned.e2_rad, 0.05, 1e-9);
    // Mirror image, mirrored answer.
    EXPECT_NEAR(steer_at(-0.5, 0.0).angle_rad, -left.angle_rad, 1e-12);
  }
}

TEST(Lateral, ClampsAndSaysSo) {
  const Params p = recommended();
  const auto gains = prepare(p);
  ASSERT_TRUE(gains);
  const auto far = steer(p.lateral, *gains, {}, ego_at(0.0, -4.9, -0.5, 20.0), straight(0.0));
  EXPECT_EQ(far.angle_rad, p.lateral.angle_max_rad);
  EXPECT_TRUE(far.saturated);
  EXPECT_EQ(far.verdict, LateralVerdict::kGood);
  const auto farther = steer(p.lateral, *gains, {}, ego_at(0.0, 5.1, 0.0, 20.0), straight(0.0));
  EXPECT_EQ(farther.verdict, LateralVerdict::kTooFar);
  EXPECT_LT(farther.angle_rad, 0.0);
}

TEST(Lateral, HoldsTheAngleWithoutTrajectoryOrEgo) {
  const Params p = recommended();
  const auto gains = prepare(p);
  ASSERT_TRUE(gains);
  const world::EgoState here = ego_at(0.0, 0.0, 0.0, 20.0);
  world::Trajectory one;
  ASSERT_TRUE(one.points.push(straight(0.0).points[0]));
  for (const world::Trajectory& t : {world::Trajectory{}, one}) {
    const auto out = steer(p.lateral, *gains, {0.03}, here, t);
    EXPECT_EQ(out.verdict, LateralVerdict::kNoTrajectory);
    EXPECT_EQ(out.angle_rad, 0.03);
  }
  world::EgoState lost = here, nan = here;
  lost.validity = world::Validity::kLost;
  nan.yaw_rate_rad_per_s = kUnset;
  for (const world::EgoState& ego : {lost, nan, world::EgoState{}}) {
    const auto out = steer(p.lateral, *gains, {0.03}, ego, straight(0.0));
    EXPECT_EQ(out.verdict, LateralVerdict::kNoEgo);
    EXPECT_EQ(out.angle_rad, 0.03);
  }
}

TEST(Lateral, DesignRefusesAndNamesTheBracket) {
  Params p = recommended();
  p.lateral.weights[3].steering = 0.0;
  auto gains = design(p.lateral, p.bicycle);
  ASSERT_FALSE(gains);
  EXPECT_EQ(gains.error().place, "lateral.weights[3]");
  p = recommended();
  p.lateral.weights[5].state = {0.0, 0.0, 0.0, 0.0};  // nothing is wanted: undetectable
  gains = design(p.lateral, p.bicycle);
  ASSERT_FALSE(gains);
  EXPECT_EQ(gains.error().place, "lateral.weights[5]");
}

}  // namespace
}  // namespace pitwall::control
