// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/self_crossing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pitwall::raceline {
namespace {

std::vector<RacelinePoint> curve(std::size_t count, double (*x_m)(double), double (*y_m)(double)) {
  std::vector<RacelinePoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle_rad =
        2.0 * std::numbers::pi * (static_cast<double>(i) + 0.3) / static_cast<double>(count);
    points.push_back({.x_m = x_m(angle_rad), .y_m = y_m(angle_rad)});
  }
  return points;
}

double figure_of_eight(double angle_rad) { return 100.0 * std::sin(2.0 * angle_rad); }
double around_x(double angle_rad) { return 100.0 * std::cos(angle_rad); }
double around_y(double angle_rad) { return 100.0 * std::sin(angle_rad); }

TEST(SelfCrossing, OfACircleIsNone) {
  for (const std::size_t count : {3U, 31U, 32U, 33U, 700U})
    EXPECT_FALSE(self_crossing_of(curve(count, around_x, around_y))) << count;
}

TEST(SelfCrossing, OfAFigureOfEightIsAtItsMiddle) {
  for (const std::size_t count : {20U, 32U, 640U, 1001U}) {
    const auto points = curve(count, around_x, figure_of_eight);
    const auto crossing = self_crossing_of(points);
    ASSERT_TRUE(crossing) << count;
    for (const std::size_t piece : {crossing->first, crossing->second}) {
      const RacelinePoint &a = points[piece], &b = points[(piece + 1) % count];
      EXPECT_LE(std::min(a.x_m, b.x_m), 0.0) << count;
      EXPECT_GE(std::max(a.x_m, b.x_m), 0.0) << count;
    }
  }
}

// The piece from the last point back to the first is one as the others are.
TEST(SelfCrossing, IsFoundOnTheLastPiece) {
  const std::vector<RacelinePoint> points{
      {.x_m = 0, .y_m = 0}, {.x_m = 10, .y_m = 0}, {.x_m = 0, .y_m = 10}, {.x_m = 10, .y_m = 10}};
  const auto crossing = self_crossing_of(points);
  ASSERT_TRUE(crossing);
  EXPECT_EQ(crossing->first, 1U);
  EXPECT_EQ(crossing->second, 3U);
}

}  // namespace
}  // namespace pitwall::raceline
