// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/preview.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::control {
namespace {

constexpr double kRadius_m = 100.0;

world::Trajectory circle(double spacing_m) {
  world::Trajectory t;
  for (int i = 0; i < 100; ++i) {
    const double s = i * spacing_m, a = s / kRadius_m;
    EXPECT_TRUE(t.points.push({.s_m = s,
                               .x_m = kRadius_m * std::sin(a),
                               .y_m = kRadius_m * (1.0 - std::cos(a)),
                               .yaw_rad = wrap_pi(a),
                               .curvature_per_m = 1.0 / kRadius_m,
                               .bank_rad = 0.1,
                               .speed_mps = s,
                               .accel_mps2 = 0.0}));
  }
  return t;
}

TEST(Preview, ProjectionFindsTheStationBesideThePath) {
  const world::Trajectory t = circle(2.0);
  for (double s = 1.0; s < 190.0; s += 3.7) {
    for (const double left : {-8.0, 0.0, 8.0}) {
      const double a = s / kRadius_m;
      const auto found = project(t, (kRadius_m - left) * std::sin(a),
                                 kRadius_m - (kRadius_m - left) * std::cos(a));
      ASSERT_TRUE(found);
      EXPECT_NEAR(*found, s, 0.1) << s << ' ' << left;
    }
  }
}

TEST(Preview, GoesOnBeyondBothEnds) {
  const world::Trajectory t = circle(2.0);
  EXPECT_NEAR(project(t, -3.0, 0.5).value(), -3.0, 0.05);
  const auto& end = t.points.back();
  EXPECT_NEAR(
      project(t, end.x_m + 3.0 * std::cos(end.yaw_rad), end.y_m + 3.0 * std::sin(end.yaw_rad))
          .value(),
      end.s_m + 3.0, 0.05);
  EXPECT_FALSE(project(t, std::nan(""), 0.0));
  EXPECT_FALSE(project(world::Trajectory{}, 0.0, 0.0));
}

TEST(Preview, InterpolatesAlsoAcrossTheTurnOfTheHeading) {
  const world::Trajectory t = circle(5.0);  // 495 m: the heading passes pi
  for (double s = 0.0; s < 490.0; s += 1.3) {
    const auto p = at(t, s);
    EXPECT_NEAR(p.s_m, s, 1e-9);
    EXPECT_NEAR(wrap_pi(p.yaw_rad - s / kRadius_m), 0.0, 1e-9) << s;
    EXPECT_NEAR(std::hypot(p.x_m, p.y_m - kRadius_m), kRadius_m, 0.04);
    EXPECT_NEAR(p.speed_mps, s, 1e-9);
  }
  EXPECT_EQ(at(t, -5.0).s_m, 0.0);
  EXPECT_EQ(at(t, 1e6).s_m, t.points.back().s_m);
}

}  // namespace
}  // namespace pitwall::control
