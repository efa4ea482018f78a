// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/ghost.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/basestation/oval_course.hpp"

namespace pitwall::state {
namespace {

LastPlace place(const Oval& oval, double station_m, double speed_mps) {
  const CoursePoint at = oval.at(station_m);
  return {.x_m = at.x_m,
          .y_m = at.y_m,
          .yaw_rad = at.yaw_rad,
          .speed_mps = speed_mps,
          .sigma_m = 0.05,
          .station_m = station_m,
          .offset_m = 0.0};
}

TEST(Ghost, FollowsTheTrackAtTheLastSpeed) {
  const Oval oval;
  const Course course = oval.course();
  const LastPlace last = place(oval, 200.0, 60.0);
  for (double age_s = 0.5; age_s <= 10.0; age_s += 0.25) {
    const auto ghost = ghost_of(last, from_seconds(age_s), &course);
    ASSERT_TRUE(ghost) << age_s;
    const CoursePoint truth = oval.at(std::fmod(200.0 + 60.0 * age_s, oval.length_m()));
    EXPECT_LT(std::hypot(ghost->x_m - truth.x_m, ghost->y_m - truth.y_m), 0.1) << age_s;
  }
}

// However hard the car brakes or accelerates within the law, it is within the radius.
TEST(Ghost, TheRadiusHoldsACarThatStops) {
  const Oval oval;
  const Course course = oval.course();
  const LastPlace last = place(oval, 0.0, 60.0);
  for (double decel = -kUnknownAccel_mps2; decel <= kUnknownAccel_mps2; decel += 1.0) {
    for (double age_s = 0.5; age_s <= 10.0; age_s += 0.5) {
      const double s = 60.0 * age_s + 0.5 * decel * age_s * age_s;
      const CoursePoint car = oval.at(std::fmod(s, oval.length_m()));
      const auto ghost = ghost_of(last, from_seconds(age_s), &course);
      ASSERT_TRUE(ghost);
      EXPECT_LE(std::hypot(car.x_m - ghost->x_m, car.y_m - ghost->y_m), ghost->radius_m + 0.1);
    }
  }
}

TEST(Ghost, ThereIsNoneBeforeAndAfter) {
  const Oval oval;
  const LastPlace last = place(oval, 0.0, 60.0);
  EXPECT_FALSE(ghost_of(last, milliseconds(499), nullptr));
  EXPECT_TRUE(ghost_of(last, milliseconds(500), nullptr));
  EXPECT_TRUE(ghost_of(last, seconds(10), nullptr));
  EXPECT_FALSE(ghost_of(last, seconds(10) + milliseconds(1), nullptr));
  EXPECT_FALSE(ghost_of({}, seconds(1), nullptr));
}

TEST(Ghost, WithoutATrackItGoesStraightOn) {
  const auto ghost =
      ghost_of({.x_m = 1, .y_m = 2, .yaw_rad = 0.0, .speed_mps = 10}, seconds(2), nullptr);
  ASSERT_TRUE(ghost);
  EXPECT_DOUBLE_EQ(ghost->x_m, 21.0);
  EXPECT_DOUBLE_EQ(ghost->y_m, 2.0);
}

}  // namespace
}  // namespace pitwall::state
