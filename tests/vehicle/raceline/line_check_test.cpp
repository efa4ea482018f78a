// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/line_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/vehicle/raceline/courses.hpp"

namespace pitwall::raceline {
namespace {

// On the ring of 200 m: a circle around its middle, or around another place.
Raceline circle(double radius_m, double middle_x_m = 0.0) {
  Raceline line{"circle", Region::kInnerLane, 2.0 * std::numbers::pi * radius_m, {}, {}, kUnset};
  const auto count = static_cast<std::size_t>(std::ceil(line.length_m));
  for (std::size_t i = 0; i < count; ++i) {
    const double angle_rad =
        2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    line.points.push_back({middle_x_m + radius_m * std::cos(angle_rad),
                           radius_m * std::sin(angle_rad),
                           wrap_pi(angle_rad + 0.5 * std::numbers::pi), 1.0 / radius_m, 0.0});
  }
  return line;
}

struct Ring {
  world::TrackMap map = valid(world::TrackMap::build(ring()));
  Lanes lanes{map};
};

std::string refusal_of(const Raceline& line, const CarLimits& car = car_limits()) {
  const Ring track;
  const auto figures = check_raceline(line, track.lanes, car);
  return figures ? "" : to_string(figures.error());
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(LineCheck, TellsTheFiguresOfACircle) {
  const Ring track;
  const LineFigures f = valid(check_raceline(circle(195.0, 0.5), track.lanes, car_limits()));
  EXPECT_EQ(f.name, "circle");
  EXPECT_EQ(f.points, 1226U);
  EXPECT_NEAR(f.length_m, 1225.22, 0.01);
  // The lane is 192 to 200 m from the middle, the line 194.5 to 195.5 m, half of the car 1 m.
  EXPECT_NEAR(f.room_least.value, 1.5, 1e-3);
  EXPECT_NEAR(f.room_least.s_m, 0.5 * f.length_m, 5.0);
  EXPECT_NEAR(f.curvature_most.value, 1.0 / 195.0, 1e-12);
  EXPECT_NEAR(f.steer_rate_most.value, 0.0, 1e-12);
  EXPECT_EQ(f.speed_least.value, 70.0);
  EXPECT_LT(f.mismatch_most.value, 1e-8);
}

TEST(LineCheck, RefusesWhatLeavesItsLane) {
  const std::string out = refusal_of(circle(196.0, 4.0));
  EXPECT_TRUE(says(out, "circle: s = 0.0 m: error: leaves the inner lane")) << out;
  EXPECT_TRUE(says(out, "is 1.00 m beyond it (offset 0.00 m, allowed 1.00 to 7.00 m)")) << out;
  const std::string in = refusal_of(circle(192.5));
  EXPECT_TRUE(says(in, "the side of the car is 0.50 m beyond it")) << in;
  Raceline outer = circle(205.0);
  EXPECT_FALSE(refusal_of(outer).empty());
  outer.region = Region::kOuterLane;
  EXPECT_EQ(refusal_of(outer), "");
}

TEST(LineCheck, RefusesAKink) {
  Raceline turned = circle(196.0);
  turned.points[300].yaw_rad += 0.01;
  EXPECT_TRUE(says(refusal_of(turned), "s = 299.9 m: error: the heading is")) << refusal_of(turned);
  Raceline moved = circle(196.0);
  moved.points[300].x_m += 0.05;
  EXPECT_TRUE(says(refusal_of(moved), "the next point is")) << refusal_of(moved);
  // Aside by a millimetre: neither step nor heading tells it.
  Raceline aside = circle(196.0);
  aside.points[300].x_m += 1e-3 * std::sin(aside.points[300].yaw_rad);
  aside.points[300].y_m -= 1e-3 * std::cos(aside.points[300].yaw_rad);
  EXPECT_TRUE(says(refusal_of(aside), "the curvature jumps: the points turn with"))
      << refusal_of(aside);
}

TEST(LineCheck, RefusesACurvatureThatIsNotThatOfThePoints) {
  Raceline line = circle(196.0);
  // The point before is the first that has a part of it.
  for (std::size_t i = 500; i < 700; ++i) line.points[i].curvature_per_m = 0.004;
  const std::string refusal = refusal_of(line);
  EXPECT_TRUE(says(refusal, "s = 498.8 m: error: the curvature jumps")) << refusal;
  EXPECT_TRUE(says(refusal, "the points turn with 0.00510 1/m, the line says 0.00501 1/m"))
      << refusal;
}

// An oval is smooth; for a car that turns its wheels slowly enough it is not.
TEST(LineCheck, RefusesAJumpThatTheSteeringCannotFollow) {
  CarLimits slow = car_limits();
  slow.steer_rate_max_rad_per_s = 1e-4;
  const Ring track;
  const auto points = std::vector<Place>{{196, 0}, {0, 194}, {-196, 0}, {0, -194}};
  Raceline line = sample_raceline(valid(SpiroSpline::through(points)), track.map, 1.0);
  line.name = "oval", line.region = Region::kInnerLane;
  const LineFigures f = valid(check_raceline(line, track.lanes, car_limits()));
  EXPECT_GT(f.steer_rate_most.value, 1e-4);
  const auto refused = check_raceline(line, track.lanes, slow);
  ASSERT_FALSE(refused);
  EXPECT_TRUE(says(refused.error().what, "the curvature jumps from 0.00")) << refused.error().what;
  EXPECT_TRUE(says(refused.error().what, "at 70.0 m/s the wheels would turn at"));
}

// The rate is that of the angle at the wheels: d atan(L k)/ds v.
TEST(LineCheck, SteeringRateIsThatOfTheCurvature) {
  const Ring track;
  const auto points = std::vector<Place>{{196, 0}, {0, 194}, {-196, 0}, {0, -194}};
  const SpiroSpline spline = valid(SpiroSpline::through(points));
  double steepest = 0.0;
  for (double s_m = 0.0; s_m < spline.length_m(); s_m += 0.5)
    steepest = std::max(steepest, std::abs(spline.at(s_m).curvature_rate_per_m2));
  Raceline line = sample_raceline(spline, track.map, 1.0);
  line.region = Region::kInnerLane;
  const LineFigures f = valid(check_raceline(line, track.lanes, car_limits()));
  EXPECT_NEAR(f.steer_rate_most.value, 3.0 * steepest * 70.0, 0.01 * 3.0 * steepest * 70.0);
}

TEST(LineCheck, RefusesMoreCurvatureThanTheSteeringReaches) {
  CarLimits stiff = car_limits();
  stiff.steer_max_rad = 0.01;
  const std::string refusal = refusal_of(circle(196.0), stiff);
  EXPECT_TRUE(says(refusal, "a curvature of 0.00510 1/m, the car's steering reaches 0.00333"))
      << refusal;
}

// A loop of 40 m in a wide ring.
TEST(LineCheck, RefusesWhatCrossesItself) {
  world::TrackDescription wide = ring();
  for (world::TrackKnot& k : wide.knots) k.width_left_m = k.width_right_m = 100.0;
  const world::TrackMap map = valid(world::TrackMap::build(wide));
  std::vector<Place> points;
  for (int i = 0; i < 24; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / 24.0;
    // Limacon: goes round twice, the second time inside.
    const double radius_m = 150.0 + 30.0 * std::cos(0.5 * 2.0 * angle_rad);
    points.push_back({radius_m * std::cos(2.0 * angle_rad), radius_m * std::sin(2.0 * angle_rad)});
  }
  Raceline line = sample_raceline(valid(SpiroSpline::through(points)), map, 1.0);
  line.name = "limacon", line.region = Region::kInnerLane;
  const auto refused = check_raceline(line, Lanes{map}, car_limits());
  ASSERT_FALSE(refused);
  EXPECT_TRUE(says(to_string(refused.error()), "m: error: the line crosses itself, at s = "))
      << to_string(refused.error());
}

TEST(LineCheck, RefusesWhatGoesTheOtherWayRound) {
  Raceline line = circle(196.0);
  for (RacelinePoint& p : line.points) {
    p.y_m = -p.y_m, p.yaw_rad = -p.yaw_rad, p.curvature_per_m = -p.curvature_per_m;
  }
  EXPECT_TRUE(says(refusal_of(line), "goes -1256.6 m along the track, expected one lap of 1256.6"))
      << refusal_of(line);
}

TEST(LineCheck, RefusesWhatHasNoPoints) {
  Raceline line = circle(196.0);
  line.points[7].bank_rad = kUnset;
  EXPECT_TRUE(says(refusal_of(line), "s = 7.0 m: error: a value is missing"));
  line.points.resize(15);
  EXPECT_TRUE(says(refusal_of(line), "15 points, at least 16 expected"));
  Raceline coarse = circle(196.0);
  coarse.points.resize(200);
  EXPECT_TRUE(says(refusal_of(coarse), "a length of 1231.5 m for 200 points"));
  coarse.length_m = kUnset;
  EXPECT_TRUE(says(refusal_of(coarse), "for 200 points"));
}

}  // namespace
}  // namespace pitwall::raceline
