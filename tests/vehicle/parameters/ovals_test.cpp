// The tracks that ship, against what is published of them: Indianapolis and Texas here, Las Vegas
// against its map in track_file_test.cpp. A turn's length runs from the middle of one ramp of
// curvature to the middle of the other: that is where an arc without ramps would begin and end.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "vehicle/parameters/track_file.hpp"

namespace pitwall::parameters {
namespace {

using world::TrackMap;
using world::TrackPoint;

constexpr double kStep_m = 0.25;
constexpr double kRamp_m = 50.0;  // more than half of one

TrackMap track(const std::string& name) {
  const auto path = std::filesystem::path(PITWALL_SOURCE_DIR) / "vehicle/config/tracks" / name;
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  const auto description = read_track(text.str(), name);
  if (!description) throw std::runtime_error(to_string(description.error()));
  auto map = TrackMap::build(*description);
  if (!map) throw std::runtime_error(to_string(map.error()));
  return *std::move(map);
}

double width_m(const TrackPoint& p) { return p.width_left_m + p.width_right_m; }

// A stretch whose curvature stays above half of the given one.
struct Turn {
  double from_m = 0.0, to_m = 0.0, peak_per_m = 0.0;
  TrackPoint middle;

  double length_m() const { return to_m - from_m; }
};

// Begins in the middle of the front stretch, which is no turn on these two tracks.
std::vector<Turn> turns(const TrackMap& map, double curvature_per_m) {
  std::vector<Turn> found;
  bool inside = false;
  for (double s_m = 0.0; s_m < map.length_m(); s_m += kStep_m) {
    const double k = map.at(s_m).curvature_per_m;
    const bool now = k > 0.5 * curvature_per_m;
    if (now && !inside) found.push_back({.from_m = s_m, .middle = {}});
    inside = now;
    if (!now) continue;
    Turn& turn = found.back();
    turn.to_m = s_m;
    turn.peak_per_m = std::max(turn.peak_per_m, k);
  }
  for (Turn& turn : found) turn.middle = map.at(0.5 * (turn.from_m + turn.to_m));
  return found;
}

struct Shipped : ::testing::TestWithParam<const char*> {};

TEST_P(Shipped, ClosesToAMillimetre) {
  const TrackMap map = track(GetParam());
  const TrackPoint end = map.at(std::nextafter(map.length_m(), 0.0)), start = map.at(0.0);
  EXPECT_LT(std::hypot(end.x_m - start.x_m, end.y_m - start.y_m), 1e-3);
  EXPECT_NEAR(wrap_pi(end.yaw_rad - start.yaw_rad), 0.0, 1e-9);
}

// Closing may not bend what the file says: the files close by themselves, or nearly.
TEST_P(Shipped, IsAsStraightAsItsFileSays) {
  const TrackMap map = track(GetParam());
  double turned_rad = 0.0, least_per_m = 1.0;
  for (double s_m = 0.0; s_m < map.length_m(); s_m += kStep_m) {
    turned_rad += map.at(s_m).curvature_per_m * kStep_m;
    least_per_m = std::min(least_per_m, map.at(s_m).curvature_per_m);
  }
  EXPECT_NEAR(turned_rad, 2.0 * std::numbers::pi, 0.01) << "once round, to the left";
  EXPECT_NEAR(least_per_m, 0.0, 3e-5);
}

// Curvature and banking without a step: a ramp at each end of every turn.
TEST_P(Shipped, EveryTurnHasRamps) {
  const TrackMap map = track(GetParam());
  for (double s_m = 0.0; s_m < map.length_m(); s_m += kStep_m) {
    const TrackPoint a = map.at(s_m), b = map.at(s_m + kStep_m);
    ASSERT_LT(std::abs(b.curvature_per_m - a.curvature_per_m), 1e-4 * kStep_m) << s_m;
    ASSERT_LT(std::abs(to_deg(b.bank_rad - a.bank_rad)), 0.4 * kStep_m) << s_m;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Shipped, ::testing::Values("lvms.yaml", "ims.yaml", "tms.yaml"),
                         [](const auto& name) { return std::string(name.param).substr(0, 3); });

TEST(Indianapolis, HasFourEqualTurnsOfAQuarterMile) {
  const TrackMap map = track("ims.yaml");
  EXPECT_NEAR(map.length_m(), 4023.36, 0.01);
  const auto all = turns(map, 1.0 / 256.0);
  ASSERT_EQ(all.size(), 4u);
  for (const Turn& turn : all) {
    EXPECT_NEAR(turn.length_m(), 402.34, 2.0);
    const double before_rad = map.at(turn.from_m - kRamp_m).yaw_rad;
    const double after_rad = map.at(turn.to_m + kRamp_m).yaw_rad;
    EXPECT_NEAR(to_deg(wrap_pi(after_rad - before_rad)), 90.0, 0.5);
    EXPECT_NEAR(1.0 / turn.peak_per_m, 256.0, 2.0);
    EXPECT_NEAR(to_deg(turn.middle.bank_rad), 9.2, 0.05);
    EXPECT_NEAR(width_m(turn.middle), 18.0, 0.1);
  }
}

TEST(Indianapolis, HasStraightsOfFiveEighthsAndChutesOfAnEighth) {
  const TrackMap map = track("ims.yaml");
  const auto all = turns(map, 1.0 / 256.0);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_NEAR(all[1].from_m - all[0].to_m, 201.17, 2.0);
  EXPECT_NEAR(all[2].from_m - all[1].to_m, 1005.84, 2.0);
  EXPECT_NEAR(all[3].from_m - all[2].to_m, 201.17, 2.0);
  EXPECT_NEAR(all[0].from_m + map.length_m() - all[3].to_m, 1005.84, 2.0);
  for (const double s_m : {0.0, 1005.9, 2011.7, 3017.5}) {
    const TrackPoint p = map.at(s_m);
    EXPECT_NEAR(p.curvature_per_m, 0.0, 2e-5) << s_m;
    EXPECT_NEAR(to_deg(p.bank_rad), 0.0, 0.05) << s_m;
    EXPECT_NEAR(width_m(p), 15.0, 0.1) << s_m;
  }
}

TEST(Texas, HasTheTwoStretchesOfItsLength) {
  const TrackMap map = track("tms.yaml");
  EXPECT_NEAR(map.length_m(), 2414.0, 0.01);
  // Dog-leg, turns 1 and 2, turns 3 and 4, dog-leg.
  const auto all = turns(map, 1.0 / 252.0);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_NEAR(all[1].from_m + map.length_m() - all[2].to_m, 686.0, 2.0) << "front stretch";
  EXPECT_NEAR(all[2].from_m - all[1].to_m, 405.0, 2.0) << "back stretch";
  EXPECT_LT(all[0].length_m(), 200.0);
  EXPECT_LT(all[3].length_m(), 200.0);
  for (const double s_m : {0.0, 203.0, 1207.0, 2211.0})
    EXPECT_NEAR(to_deg(map.at(s_m).bank_rad), 5.0, 0.05) << s_m;
}

TEST(Texas, HasTwoEndsThatDiffer) {
  const auto all = turns(track("tms.yaml"), 1.0 / 252.0);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_NEAR(to_deg(all[1].middle.bank_rad), 20.0, 0.05);
  EXPECT_NEAR(to_deg(all[2].middle.bank_rad), 24.0, 0.05);
  EXPECT_NEAR(width_m(all[1].middle), 24.0, 0.1);
  EXPECT_LT(width_m(all[2].middle), width_m(all[1].middle) - 2.0);
}

}  // namespace
}  // namespace pitwall::parameters
