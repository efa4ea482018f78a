// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/trail.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/vehicle/autonomy/localization/course_geometry.hpp"
#include "tests/vehicle/autonomy/localization/drive.hpp"

namespace pitwall::localization {
namespace {

using testing::banked_turn;
using testing::Course;

Estimate estimate_of(const Course& course, double t_s) {
  const world::EgoState e = course.at(t_s);
  const Eigen::Vector3d w = rate(course, t_s);
  Estimate out;
  out.at = Instant{std::llround(t_s * 1e9)};
  out.position_m = {e.x_m, e.y_m, e.z_m};
  out.yaw_rad = e.yaw_rad, out.pitch_rad = e.pitch_rad, out.roll_rad = e.roll_rad;
  out.velocity_mps = {e.vx_mps, e.vy_mps, 0.0};
  out.rate_rad_per_s = {w.x(), w.y(), w.z()};
  out.position_sigma_m = 0.01;
  return out;
}

Trail trail_of(const Course& course, int ticks, bool planar = false) {
  Trail trail;
  for (int i = 0; i < ticks; ++i) {
    Estimate e = estimate_of(course, 0.01 * i);
    if (planar) e.pitch_rad = e.roll_rad = e.position_m[2] = kUnset;
    trail.note(e, course.surroundings(0.01 * i).road);
  }
  return trail;
}

TEST(Trail, KnowsNothingBeforeItsFirstTickNorBeforeItsOldest) {
  EXPECT_FALSE(Trail{}.at(Instant{}));
  EXPECT_EQ(Trail{}.newest(), nullptr);
  const Trail trail = trail_of(banked_turn(), 200);
  EXPECT_FALSE(trail.at(Instant{milliseconds(1'000).ns}));
  EXPECT_TRUE(trail.at(Instant{milliseconds(1'500).ns}));
  EXPECT_FALSE(trail.at(Instant{milliseconds(2'500).ns}));
}

// Against the path of the antennas, differentiated: at every instant, on a banked turn at speed.
TEST(Trail, AnAntennaIsWhereTheCarCarriesIt) {
  const Course course = banked_turn(68.0);
  for (const bool planar : {false, true}) {
    const Trail trail = trail_of(course, 50, planar);
    for (int ms = 200; ms < 500; ms += 7) {
      const auto moment = trail.at(Instant{milliseconds(ms).ns});
      ASSERT_TRUE(moment);
      const double t = ms * 1e-3, h = 1e-4;
      const LeverArm arm{0.758, -0.497, 0.109};
      const auto path = [&](double s) -> Eigen::Vector3d {
        return place(course, s) + attitude(course, s) * Eigen::Vector3d{arm.x_m, arm.y_m, arm.z_m};
      };
      const Eigen::Vector3d at = path(t), speed = (path(t + h) - path(t - h)) / (2 * h);
      const auto lever = moment->arm_m(arm), velocity = moment->antenna_mps(arm);
      EXPECT_NEAR(moment->x_m + lever.x, at.x(), 0.005) << ms;
      EXPECT_NEAR(moment->y_m + lever.y, at.y(), 0.005) << ms;
      EXPECT_NEAR(velocity.x, speed.x(), planar ? 0.4 : 0.02) << ms;
      EXPECT_NEAR(velocity.y, speed.y(), planar ? 0.4 : 0.02) << ms;
      EXPECT_NEAR(wrap_pi(moment->yaw_rad - course.at(t).yaw_rad), 0.0, 1e-4);
      EXPECT_NEAR(wrap_pi(moment->course_rad() - course.course_rad(t)), 0.0, 2e-3);
    }
  }
}

TEST(Trail, ABaselineAcrossABankedCarPointsWhereItPoints) {
  const Course course = banked_turn();
  const Moment moment = *trail_of(course, 10).newest();
  for (const double direction : {0.0, std::numbers::pi / 2.0, -1.0}) {
    const Eigen::Vector3d line =
        attitude(course, 0.09) * Eigen::Vector3d{std::cos(direction), std::sin(direction), 0.0};
    EXPECT_NEAR(wrap_pi(moment.azimuth_rad(direction) - std::atan2(line.y(), line.x())), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace pitwall::localization
