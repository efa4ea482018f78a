// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/lidar/body_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/hil/traffic/oval.hpp"

namespace pitwall::sensors {
namespace {

TEST(BodyMotion, WheelsOfBothSidesAreOnTheRoad) {
  for (const double s_m : {100.0, 600.0, 1'200.0}) {
    for (const double n_m : {-4.0, 0.0, 5.0}) {
      const world::TrackPoint at = traffic::oval().offset(s_m, n_m);
      const BodyMotion body = motion_on_road(traffic::oval(), {.x_m = at.x_m,
                                                               .y_m = at.y_m,
                                                               .yaw_rad = at.yaw_rad,
                                                               .vx_mps = 60.0,
                                                               .vy_mps = -1.0,
                                                               .yaw_rate_rad_per_s = 0.3,
                                                               .s_m = s_m,
                                                               .n_m = n_m});
      const Rotation axes = rotation(body.attitude);
      for (const double left_m : {-0.8, 0.8}) {
        const Vector3 wheel = plus(body.at_m, turned(axes, {0.0, left_m, 0.0}));
        const world::Curvilinear under = traffic::oval().project(wheel[0], wheel[1], s_m);
        EXPECT_NEAR(wheel[2], traffic::oval().road(under.s_m, under.n_m).height_m, 0.005) << s_m;
      }
      EXPECT_NEAR(std::hypot(body.velocity_mps[0], body.velocity_mps[1], body.velocity_mps[2]),
                  std::hypot(60.0, 1.0), 1e-9);
      EXPECT_EQ(body.yaw_rate_rad_per_s, 0.3);
    }
  }
}

TEST(BodyMotion, AnotherOriginIsAboveTheRoadSquareToIt) {
  const world::TrackPoint at = traffic::oval().offset(600.0, 2.0);
  const plant::CarPose car{.x_m = at.x_m,
                           .y_m = at.y_m,
                           .yaw_rad = at.yaw_rad,
                           .vx_mps = 0.0,
                           .vy_mps = 0.0,
                           .yaw_rate_rad_per_s = 0.0,
                           .s_m = 600.0,
                           .n_m = 2.0};
  const Vector3 foot = motion_on_road(traffic::oval(), car).at_m;
  const Vector3 origin = motion_on_road(traffic::oval(), car, 0.5).at_m;
  const Vector3 up = plus(origin, times(-1.0, foot));
  EXPECT_NEAR(std::hypot(up[0], up[1], up[2]), 0.5, 1e-12);
  EXPECT_NEAR(up[2], 0.5 * std::cos(0.1), 1e-3) << "the banking";
}

}  // namespace
}  // namespace pitwall::sensors
