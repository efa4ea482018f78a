// SPDX-License-Identifier: Apache-2.0
#include "hil/report/ground_charts.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/hil/report/some_run.hpp"

namespace pitwall::report {
namespace {

// A circle of 200 m, 20 m wide.
world::TrackMap circle() {
  const double length_m = 200.0;
  world::TrackDescription track;
  track.name = "circle";
  track.length_m = length_m;
  track.datum_latitude_deg = track.datum_longitude_deg = track.datum_height_m = 0.0;
  for (int i = 0; i < 8; ++i)
    track.knots.push_back({.s_m = 0.125 * i * length_m,
                           .curvature_per_m = 2.0 * std::numbers::pi / length_m,
                           .bank_rad = 0.0,
                           .width_left_m = 10.0,
                           .width_right_m = 10.0});
  const auto map = world::TrackMap::build(track);
  if (!map) ADD_FAILURE() << to_string(map.error());
  return *map;
}

TEST(Map, HasWallsWhereTheTrackIsKnown) {
  const RunData run = run_of({.with_failure = true});
  const world::TrackMap track = circle();
  const std::string with = map_chart(run, &track, "");
  EXPECT_EQ(count(with, "data-absent"), 0u);
  EXPECT_NE(with.find("Map of circle"), std::string::npos);
  const std::string without = map_chart(run, nullptr, "no such file");
  EXPECT_EQ(count(without, "data-absent=\"walls\""), 1u);
  EXPECT_NE(without.find("no such file"), std::string::npos);
  EXPECT_EQ(count(with, "class=\"mark\""), count(without, "class=\"mark\"") + 2u);
}

TEST(Map, ShowsStartFaultAndViolation) {
  const std::string html = map_chart(run_of({.with_failure = true}), nullptr, "");
  EXPECT_EQ(count(html, "class=\"sign\""), 3u);
  EXPECT_EQ(count(html, "6.50 s: first violation"), 1u);
  EXPECT_EQ(count(html, "4.00 s: fault steering_stuck"), 1u);
}

TEST(Map, WithoutATruthSaysSo) {
  EXPECT_EQ(count(map_chart(RunData{}, nullptr, ""), "data-absent=\"map\""), 1u);
}

TEST(Station, LapsAreSeparateLines) {
  // 310 m in 10 s over a lap of 200 m: two lines.
  const std::string html = station_chart(run_of({}));
  const std::size_t mark = html.find("class=\"mark\"");
  const std::string path = html.substr(html.find(" d=\"", mark));
  EXPECT_EQ(count(path.substr(0, path.find("/>")), "M"), 2u);
}

TEST(Accelerations, LeftIsOnTheLeft) {
  const std::string html = acceleration_chart(run_of({}));
  EXPECT_EQ(count(html, "data-plot=\"gg\""), 1u);
  const std::size_t at = html.find("data-x0=\"");
  EXPECT_NE(html[at + 9], '-') << "the axis begins with the positive side";
}

TEST(Brackets, AreThoseOfTheBench) {
  const grading::CrossTrack statistics =
      cross_track_of(run_of({.speed_mps = 31.0, .error_m = -0.5}));
  EXPECT_EQ(statistics.overall.samples, 1001u);
  EXPECT_DOUBLE_EQ(statistics.overall.mean_m(), 0.5);
  EXPECT_EQ(statistics.by_bracket[6].samples, 1001u) << "30 to 35 m/s";
  const std::string table = bracket_table(statistics);
  EXPECT_EQ(count(table, "<td>1001</td><td>0.500</td><td>0.500</td>"), 2u) << "bracket and overall";
  EXPECT_EQ(count(table, "real car"), 1u);
  EXPECT_EQ(count(table, "class=\"paper\""), 22u);
}

TEST(Brackets, ACarThatStoodHasNoBars) {
  const auto statistics = cross_track_of(run_of({.speed_mps = 3.0}));
  EXPECT_EQ(count(bracket_chart(statistics), "data-absent=\"brackets\""), 1u);
}

}  // namespace
}  // namespace pitwall::report
