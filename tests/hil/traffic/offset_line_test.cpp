// SPDX-License-Identifier: Apache-2.0
#include "hil/traffic/offset_line.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/hil/traffic/oval.hpp"

namespace pitwall::traffic {
namespace {

// Cubic Hermite over 1 m: h^4 / 384 times the fourth derivative of the swing, 3e-8 m/m^4, and the
// place of the points, which project() finds to 1e-10 m.
constexpr double kError_m = 1e-8;

TEST(OffsetLine, OfARacelineHasItsOffsetAndSlope) {
  const auto line = OffsetLine::of(bank().lines[0], oval(), 0.75);
  ASSERT_TRUE(line) << to_string(line.error());
  for (double s_m = 0.0; s_m < oval().length_m(); s_m += 0.37) {
    EXPECT_NEAR(line->at(s_m).n_m, swing_n_m(s_m) + 0.75, kError_m) << s_m;
    EXPECT_NEAR(line->at(s_m).slope, swing_slope(s_m), 1e-6) << s_m;
  }
}

TEST(OffsetLine, AtAnOffsetIsParallel) {
  const OffsetLine line(-3.0);
  EXPECT_EQ(line.at(123.0).n_m, -3.0);
  EXPECT_EQ(line.at(123.0).slope, 0.0);
}

TEST(OffsetLine, RefusesALineThatDoesNotFollowTheTrack) {
  world::Raceline line = bank().lines[0];
  std::reverse(line.points.begin(), line.points.end());
  EXPECT_FALSE(OffsetLine::of(line, oval(), 0.0));
  line = bank().lines[0];
  for (auto& p : line.points) p.yaw_rad = wrap_pi(p.yaw_rad + 2.0);
  EXPECT_FALSE(OffsetLine::of(line, oval(), 0.0));
  line.points.clear();
  EXPECT_FALSE(OffsetLine::of(line, oval(), 0.0));
  line = bank().lines[0];
  line.points.insert(line.points.end(), line.points.begin(), line.points.end());  // two laps
  EXPECT_FALSE(OffsetLine::of(line, oval(), 0.0));
}

TEST(OffsetLine, TouchesAWallWhereTheCarDoes) {
  EXPECT_FALSE(touches_wall(OffsetLine(7.0), oval(), 0.99));
  EXPECT_TRUE(touches_wall(OffsetLine(7.0), oval(), 1.01));
  EXPECT_TRUE(touches_wall(OffsetLine(-7.0), oval(), 1.01));
}

}  // namespace
}  // namespace pitwall::traffic
