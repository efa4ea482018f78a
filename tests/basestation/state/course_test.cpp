// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/course.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/basestation/oval_course.hpp"

namespace pitwall::state {
namespace {

TEST(Course, FollowsTheLineItWasMadeOf) {
  const Oval oval;
  const Course course = oval.course();
  for (double s = 0.5; s < oval.length_m(); s += 7.3) {
    const CoursePoint truth = oval.at(s);
    const CoursePose pose = course.at(s, 0.0);
    EXPECT_NEAR(pose.x_m, truth.x_m, 0.05) << s;
    EXPECT_NEAR(pose.y_m, truth.y_m, 0.05) << s;
    EXPECT_NEAR(wrap_pi(pose.yaw_rad - truth.yaw_rad), 0.0, 0.03) << s;
    const CoursePose left = course.at(s, 3.0);
    EXPECT_NEAR(std::hypot(left.x_m - pose.x_m, left.y_m - pose.y_m), 3.0, 1e-9);
  }
}

TEST(Course, ALapLaterIsTheSamePlace) {
  const Course course = Oval{}.course();
  for (double s = 0.0; s < course.length_m(); s += 97.0) {
    for (const double laps : {-2.0, -1.0, 1.0, 3.0}) {
      EXPECT_NEAR(course.at(s, 1.0).x_m, course.at(s + laps * course.length_m(), 1.0).x_m, 1e-6);
      EXPECT_NEAR(course.to_corner_m(s), course.to_corner_m(s + laps * course.length_m()), 1e-6);
    }
  }
}

TEST(Course, FindsTheTwoTurnsOfAnOval) {
  const Oval oval;
  const Course course = oval.course();
  ASSERT_EQ(course.corners().size(), 2U);
  for (double s = 0.0; s < oval.length_m(); s += 5.0) {
    const double ahead = course.to_corner_m(s);
    const bool in_turn = oval.at(s).curvature_per_m > 0.0;
    EXPECT_LE(ahead, in_turn ? 5.0 : oval.straight_m) << s;
    EXPECT_TRUE(ahead > 0.0 || in_turn) << s;
  }
  EXPECT_NEAR(course.to_corner_m(0.0), 300.0, 5.0);
}

TEST(Course, ATurnAcrossTheStartLineIsOne) {
  const Oval oval;
  std::vector<CoursePoint> points;
  const double shift =
      oval.straight_m / 2.0 + oval.turn_m() / 2.0;  // starts in the middle of a turn
  for (double s = 0.0; s < oval.length_m() - 2.5; s += 5.0) {
    CoursePoint point = oval.at(std::fmod(s + shift, oval.length_m()));
    point.s_m = s;
    points.push_back(point);
  }
  const Course course = *Course::make(std::move(points), oval.length_m());
  EXPECT_EQ(course.corners().size(), 2U);
  EXPECT_EQ(course.to_corner_m(0.0), 0.0);
}

TEST(Course, BadPointsAreRefused) {
  const Oval oval;
  const auto make = [&](auto spoil) {
    std::vector<CoursePoint> points;
    for (double s = 0.0; s < 50.0; s += 10.0) points.push_back(oval.at(s));
    double length = oval.length_m();
    spoil(points, length);
    return Course::make(points, length).has_value();
  };
  EXPECT_TRUE(make([](auto&, double&) {}));
  EXPECT_FALSE(make([](auto& points, double&) { points.resize(3); }));
  EXPECT_FALSE(make([](auto& points, double&) { points[2].x_m = kUnset; }));
  EXPECT_FALSE(make([](auto& points, double&) { std::swap(points[1], points[2]); }));
  EXPECT_FALSE(make([](auto&, double& length) { length = 20.0; }));
  EXPECT_FALSE(make([](auto& points, double&) { points[0].s_m = -1.0; }));
}

// The lane lies across the start line, as that of most ovals.
TEST(Course, ThePitLaneIsBesideTheLineNotOnIt) {
  const Oval oval;
  Course course = oval.course();
  EXPECT_FALSE(course.in_pit(0.0, 20.0)) << "no lane is known";
  course.set_pit({.from_s_m = oval.length_m() - 200.0, .to_s_m = 200.0, .offset_m = 20.0});
  for (const double s : {oval.length_m() - 199.0, 0.0, 199.0, oval.length_m() + 10.0}) {
    EXPECT_TRUE(course.in_pit(s, 20.0)) << s;
    EXPECT_TRUE(course.in_pit(s, 11.0)) << s;
    EXPECT_FALSE(course.in_pit(s, 9.0)) << s << ": nearer to the line";
    EXPECT_FALSE(course.in_pit(s, -20.0)) << s;
  }
  EXPECT_FALSE(course.in_pit(201.0, 20.0));
  EXPECT_FALSE(course.in_pit(oval.length_m() - 201.0, 20.0));
}

}  // namespace
}  // namespace pitwall::state
