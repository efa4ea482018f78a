// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/line.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/vehicle/autonomy/planning/stadium.hpp"

namespace pitwall::planning {
namespace {

LineParams line_params(double offset_m) {
  LineParams p = testing::recommended().line;
  p.offset_m = offset_m;
  return p;
}

TEST(Line, OffsetShortensALapByTwoPiTimesTheOffset) {
  const world::TrackMap track = testing::stadium();
  for (const double offset : {-6.0, 0.0, 3.0}) {
    const auto line = build_line(track, line_params(offset));
    ASSERT_TRUE(line);
    EXPECT_NEAR(line->length_m, track.length_m() - 2.0 * std::numbers::pi * offset, 0.02);
    EXPECT_NEAR(line->spacing_m, 2.0, 0.01);
  }
}

TEST(Line, GeometryIsConsistent) {
  const world::TrackMap track = testing::stadium();
  const auto built = build_line(track, line_params(3.0));
  ASSERT_TRUE(built);
  const Line& line = *built;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const LinePoint& a = line.points[i];
    const LinePoint& b = line.points[(i + 1) % line.points.size()];
    EXPECT_NEAR(std::hypot(b.x_m - a.x_m, b.y_m - a.y_m), line.spacing_m, 1e-3) << i;
    const double turned = wrap_pi(b.yaw_rad - a.yaw_rad) / line.spacing_m;
    EXPECT_NEAR(turned, 0.5 * (a.curvature_per_m + b.curvature_per_m), 2e-5) << i;
    const auto c = track.project(a.x_m, a.y_m, a.track_s_m);
    EXPECT_NEAR(c.n_m, 3.0, 1e-3) << i;
    EXPECT_NEAR(std::remainder(c.s_m - a.track_s_m, track.length_m()), 0.0, 0.02) << i;
  }
}

TEST(Line, ProjectInvertsAt) {
  const auto line = build_line(testing::stadium(), line_params(0.0));
  ASSERT_TRUE(line);
  for (double s = 0.3; s < line->length_m; s += 17.3) {
    for (const double n : {-5.0, 0.0, 4.0}) {
      const LinePoint p = line->at(s);
      const double x = p.x_m - n * std::sin(p.yaw_rad), y = p.y_m + n * std::cos(p.yaw_rad);
      for (const std::optional<double> hint :
           {std::optional<double>{}, std::optional{s + 30.0}, std::optional{s - 30.0}}) {
        const LinePosition found = line->project(x, y, hint);
        EXPECT_NEAR(std::remainder(found.s_m - s, line->length_m), 0.0, 0.02) << s << ' ' << n;
        EXPECT_NEAR(found.offset_m, n, 1e-3) << s << ' ' << n;
      }
    }
  }
  EXPECT_TRUE(std::isnan(line->project(kUnset, 0.0).s_m));
}

TEST(Line, WrapsEveryStation) {
  const auto line = build_line(testing::stadium(), line_params(0.0));
  ASSERT_TRUE(line);
  for (const double s : {-1e-18, -1.0, 0.0, line->length_m, 3.5 * line->length_m, -1e6}) {
    EXPECT_GE(line->wrap(s), 0.0);
    EXPECT_LT(line->wrap(s), line->length_m);
  }
  const LinePoint end = line->at(line->length_m - 1e-6), start = line->at(0.0);
  EXPECT_NEAR(std::hypot(end.x_m - start.x_m, end.y_m - start.y_m), 0.0, 1e-4);
}

TEST(Line, RefusesToLeaveTheRoad) {
  const world::TrackMap track = testing::stadium();  // 8 m to either wall
  EXPECT_TRUE(build_line(track, line_params(6.4)));
  EXPECT_TRUE(build_line(track, line_params(-6.4)));
  for (const double offset : {6.6, -6.6, 30.0}) {
    const auto line = build_line(track, line_params(offset));
    ASSERT_FALSE(line) << offset;
    EXPECT_EQ(line.error().place, "line.offset_m");
  }
}

// A bank whose only line lies at this offset from the reference line.
world::RacelineBank bank_at(const world::TrackMap& track, double offset_m) {
  const Line line = build_line(track, line_params(offset_m)).value();
  world::Raceline raceline{.name = "aside", .length_m = line.length_m, .points = {}};
  for (const LinePoint& p : line.points)
    raceline.points.push_back({p.x_m, p.y_m, p.yaw_rad, p.curvature_per_m, p.bank_rad});
  return {.track = "stadium", .track_fingerprint = "", .lines = {raceline}};
}

LineParams from_bank() {
  LineParams p = line_params(0.0);
  p.bank = "bank.json", p.name = "aside";
  return p;
}

TEST(Line, ARacelineAtAnOffsetIsTheLineAtThatOffset) {
  const world::TrackMap track = testing::stadium();
  for (const double offset : {-5.0, 0.0, 4.0}) {
    const Line line = build_line(track, line_params(offset)).value();
    const world::RacelineBank bank = bank_at(track, offset);
    const Line same = build_line(track, from_bank(), &bank).value();
    EXPECT_EQ(line.number, 0u);
    EXPECT_EQ(same.number, 1u);
    EXPECT_EQ(same.length_m, line.length_m);
    EXPECT_NEAR(same.spacing_m, line.spacing_m, 1e-12);
    ASSERT_EQ(same.points.size(), line.points.size());
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const LinePoint &a = line.points[i], &b = same.points[i];
      EXPECT_NEAR(a.s_m, b.s_m, 1e-9);
      EXPECT_NEAR(std::remainder(a.track_s_m - b.track_s_m, track.length_m()), 0.0, 1e-3) << i;
      EXPECT_EQ(a.x_m, b.x_m);
      EXPECT_EQ(a.cos_yaw, b.cos_yaw);
      EXPECT_EQ(a.curvature_per_m, b.curvature_per_m);
      for (std::size_t row = 0; row < a.speed_mps.size(); ++row)
        EXPECT_NEAR(a.speed_mps[row], b.speed_mps[row], 1e-9);
      EXPECT_NEAR(a.room_left_m, b.room_left_m, 1e-4) << i;
      EXPECT_NEAR(a.room_right_m, b.room_right_m, 1e-4) << i;
    }
  }
}

TEST(Line, RefusesALineThatItsBankLacks) {
  const world::TrackMap track = testing::stadium();
  world::RacelineBank bank = bank_at(track, 0.0);
  bank.source = "bank.json";
  LineParams params = from_bank();
  params.name = "inner/apex";
  const auto line = build_line(track, params, &bank);
  ASSERT_FALSE(line);
  EXPECT_EQ(line.error().place, "line.name");
  EXPECT_NE(line.error().what.find("bank.json has no line \"inner/apex\", but aside"),
            std::string::npos)
      << line.error().what;
}

}  // namespace
}  // namespace pitwall::planning
