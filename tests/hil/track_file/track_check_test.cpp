// SPDX-License-Identifier: Apache-2.0
#include "hil/track_file/track_check.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "protocol/yaml/strict_map.hpp"

namespace pitwall::track_file {
namespace {

constexpr double kCircleRadius_m = 100.0;
const double kCircleLength_m = 2.0 * std::numbers::pi * kCircleRadius_m;

// A circle, left-hand, with a knot every 10 m or so.
world::TrackDescription circle() {
  world::TrackDescription d;
  d.name = "circle";
  d.length_m = kCircleLength_m;
  d.datum_latitude_deg = d.datum_longitude_deg = d.datum_height_m = 0.0;
  for (int i = 0; i < 63; ++i)
    d.knots.push_back({.s_m = kCircleLength_m * i / 63,
                       .curvature_per_m = 1.0 / kCircleRadius_m,
                       .bank_rad = from_deg(10.0),
                       .width_left_m = 6.0,
                       .width_right_m = 7.0});
  return d;
}

TrackReport report(const world::TrackDescription& d) {
  const auto map = world::TrackMap::build(d);
  if (!map) throw std::runtime_error(to_string(map.error()));
  return check_track(d, *map);
}

TEST(TrackCheck, MeasuresACircle) {
  const TrackReport r = report(circle());
  EXPECT_NEAR(r.length_m, kCircleLength_m, 1e-9);
  EXPECT_NEAR(r.turned_rad, 2.0 * std::numbers::pi, 1e-6);
  EXPECT_LT(r.closure_m, 1e-3);
  EXPECT_NEAR(r.correction_share, 0.0, 1e-9);
  EXPECT_NEAR(r.curvature_max.value, 1.0 / kCircleRadius_m, 1e-9);
  EXPECT_NEAR(r.inner_room.value, kCircleRadius_m - 6.0, 1e-3);
  EXPECT_NEAR(r.width_min.value, 13.0, 1e-9);
  EXPECT_NEAR(r.wall_nearest.value, 6.0, 1e-9);
  EXPECT_NEAR(to_deg(r.bank_max.value), 10.0, 1e-9);
  EXPECT_NEAR(r.bank_change.value, 0.0, 1e-9);
  EXPECT_TRUE(r.warnings.empty());
}

struct Oddity {
  const char* says;
  double (*spoil)(world::TrackDescription& d);  // returns where
};

TEST(TrackCheck, WarnsOfWhatIsOddAndWhere) {
  const std::array oddities{
      Oddity{"m wide",
             [](auto& d) {
               d.knots[20].width_left_m = 2.0, d.knots[20].width_right_m = 2.0;
               return d.knots[20].s_m;
             }},
      Oddity{"from a wall",
             [](auto& d) {
               d.knots[30].width_left_m = 1.0;
               return d.knots[30].s_m;
             }},
      Oddity{"degrees in a metre",
             [](auto& d) {
               d.knots[40].bank_rad = from_deg(30.0);
               return d.knots[40].s_m;
             }},
      Oddity{"the inner wall turns",
             [](auto& d) {
               d.knots[10].width_left_m = 93.0;
               return d.knots[10].s_m;
             }},
      Oddity{"a wall moves",
             [](auto& d) {
               d.knots[50].width_right_m = 20.0;
               return d.knots[50].s_m;
             }},
  };
  for (const Oddity& o : oddities) {
    auto d = circle();
    const double s_m = o.spoil(d);
    const TrackReport r = report(d);
    ASSERT_FALSE(r.warnings.empty()) << o.says;
    bool found = false;
    for (const std::string& warning : r.warnings) {
      const auto at = warning.find("at s = ");
      if (warning.find(o.says) == std::string::npos || at == std::string::npos) continue;
      found = true;
      EXPECT_NEAR(std::stod(warning.substr(at + 7)), s_m, 11.0) << warning;
    }
    EXPECT_TRUE(found) << o.says;
    EXPECT_NE(to_text(r).find("warning: "), std::string::npos);
  }
}

// A table that turns too far closes only when bent; the share says by how much.
TEST(TrackCheck, SaysHowFarTheTableWasBent) {
  auto d = circle();
  for (auto& k : d.knots) k.curvature_per_m *= 1.015;
  const TrackReport r = report(d);
  EXPECT_NEAR(r.correction_share, 0.015, 1e-3);
  ASSERT_EQ(r.warnings.size(), 1u);
  EXPECT_NE(r.warnings[0].find("closes only when bent by 1.5 %"), std::string::npos);
}

TEST(TrackCheck, JsonCanBeRead) {
  auto d = circle();
  d.knots[30].width_left_m = 1.0;
  const auto read = yaml::load_text(to_json(report(d)), "report.json");
  ASSERT_TRUE(read) << to_string(read.error());
  yaml::StrictMap root = read->root();
  EXPECT_NEAR(root.number("length_m", 0.0, 1e6), kCircleLength_m, 1e-3);
  EXPECT_NEAR(root.map("wall_nearest_m").number("value", 0.0, 10.0), 1.0, 0.5);
}

}  // namespace
}  // namespace pitwall::track_file
