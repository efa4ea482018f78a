// SPDX-License-Identifier: Apache-2.0
#include "hil/track_file/track_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/hil/track_file/csv_text.hpp"

namespace pitwall::track_file {
namespace {

Result<Fit, Problem> fitted(const std::string& text, FitOptions options = {}) {
  options.name = "made up";
  const auto csv = read_track_csv(text, "t.csv");
  if (!csv) return Unexpected{csv.error()};
  return fit_track(*csv, options);
}

world::TrackMap built(const Fit& fit) {
  auto map = world::TrackMap::build(fit.track);
  if (!map) throw std::runtime_error(to_string(map.error()));
  return *std::move(map);
}

// Farthest from a measured point to the built line.
double farthest_m(const world::TrackMap& map, const std::vector<Place>& places) {
  double most_m = 0.0;
  for (const Place& p : places) most_m = std::max(most_m, std::abs(map.project(p.x_m, p.y_m).n_m));
  return most_m;
}

TEST(TrackFit, TheBuiltLineRunsThroughThePoints) {
  for (const double step_m : {1.0, 5.0, 12.0}) {
    const auto fit = fitted(csv_text(stadium(step_m)));
    ASSERT_TRUE(fit) << to_string(fit.error());
    const world::TrackMap map = built(*fit);
    EXPECT_NEAR(map.length_m(), kStadium_m, 0.002 * kStadium_m) << step_m;
    EXPECT_LT(farthest_m(map, stadium(step_m)), 0.15) << step_m;
    EXPECT_NEAR(map.at(0.25 * kStadium_m).curvature_per_m, 1.0 / kRadius_m, 0.02 / kRadius_m);
    EXPECT_NEAR(map.at(0.5 * kStadium_m).curvature_per_m, 0.0, 2e-4);
  }
}

TEST(TrackFit, ATrackDrivenTheOtherWayTurnsRight) {
  auto places = stadium();
  std::reverse(places.begin(), places.end());
  const auto fit = fitted(csv_text(places));
  ASSERT_TRUE(fit);
  EXPECT_NEAR(built(*fit).at(0.25 * kStadium_m).curvature_per_m, -1.0 / kRadius_m, 2e-4);
}

// Walls are places in the world: however the line is smoothed, they stay where they were.
TEST(TrackFit, WallsStayWhereTheyWereMeasured) {
  auto places = stadium();
  for (std::size_t i = 0; i < places.size(); ++i) places[i].y_m += i % 2 == 0 ? 0.3 : -0.3;
  const auto fit = fitted(csv_text(places, 7.0, 8.0));
  ASSERT_TRUE(fit) << to_string(fit.error());
  EXPECT_GT(fit->moved_m, 0.15) << "the jitter went";
  const auto map = built(*fit);
  for (std::size_t i = 1; i < 20; ++i) {  // on the first straight
    const auto at = map.project(places[i].x_m, places[i].y_m);
    EXPECT_LE(map.at(at.s_m).width_left_m, 8.0 + at.n_m + 0.1) << i;
    EXPECT_GE(map.at(at.s_m).width_left_m, 8.0 - 0.35) << i;
  }
}

TEST(TrackFit, ANarrowPlaceBetweenTwoKnotsIsKept) {
  std::string text = "x_m,y_m,w_tr_right_m,w_tr_left_m\n";
  const auto places = stadium(2.0);
  for (std::size_t i = 0; i < places.size(); ++i)
    text += row_text(places[i].x_m, places[i].y_m, i == 33 ? 3.0 : 9.0, 9.0);
  FitOptions options;
  options.knot_spacing_m = 10.0;
  const auto fit = fitted(text, options);
  ASSERT_TRUE(fit) << to_string(fit.error());
  const auto map = built(*fit);
  const auto at = map.project(places[33].x_m, places[33].y_m);
  EXPECT_LT(map.at(at.s_m).width_right_m, 3.1);
}

TEST(TrackFit, SaysWhatItLeftOut) {
  auto places = stadium();
  places.insert(places.begin() + 4, {places[3].x_m + 0.1, places[3].y_m});
  places.push_back(places.front());
  const auto fit = fitted(csv_text(places));
  ASSERT_TRUE(fit) << to_string(fit.error());
  EXPECT_EQ(fit->removed, 2u);
  EXPECT_TRUE(std::isnan(fit->height_range_m));
}

TEST(TrackFit, LooksAtHeights) {
  std::string text = "x_m,y_m,w_tr_right_m,w_tr_left_m,z_m\n";
  for (const Place& p : stadium()) {
    text += row_text(p.x_m, p.y_m, 7.0, 7.0);
    text.back() = ',';
    text += std::to_string(0.02 * p.x_m) + "\n";
  }
  const auto fit = fitted(text);
  ASSERT_TRUE(fit) << to_string(fit.error());
  EXPECT_NEAR(fit->gradient_max, 0.02, 1e-3);
  EXPECT_NEAR(fit->height_range_m, 0.02 * (kStraight_m + 2.0 * kRadius_m), 0.2);
}

// Stations and curvature instead of places: the table of a shipped track gives that track.
TEST(TrackFit, StationsAndCurvatureGiveTheSameTrack) {
  std::ifstream file(std::string(PITWALL_SOURCE_DIR) + "/vehicle/config/tracks/tms.yaml");
  std::stringstream yaml;
  yaml << file.rdbuf();
  const auto ours = parameters::read_track(yaml.str(), "tms.yaml");
  ASSERT_TRUE(ours);
  const auto map = world::TrackMap::build(*ours);
  ASSERT_TRUE(map);
  std::string text = "s_m,curvature_per_m,w_tr_right_m,w_tr_left_m,bank_deg\n";
  for (int i = 0; i <= 1207; ++i) {
    const double s_m = 2.0 * i;
    const auto p = map->at(s_m);
    text += row_text(100.0 + s_m, p.curvature_per_m, p.width_right_m, p.width_left_m);
    text.back() = ',';
    text += std::to_string(to_deg(p.bank_rad)) + "\n";
  }
  const auto fit = fitted(text);
  ASSERT_TRUE(fit) << to_string(fit.error());
  const auto theirs = built(*fit);
  EXPECT_NEAR(theirs.length_m(), 2414.0, 1e-6);
  for (double s_m = 0.0; s_m < 2414.0; s_m += 11.0) {
    ASSERT_NEAR(theirs.at(s_m).curvature_per_m, map->at(s_m).curvature_per_m, 1e-4) << s_m;
    ASSERT_NEAR(theirs.at(s_m).bank_rad, map->at(s_m).bank_rad, from_deg(0.5)) << s_m;
    ASSERT_NEAR(theirs.at(s_m).width_left_m, map->at(s_m).width_left_m, 0.3) << s_m;
  }
}

std::string without(std::vector<Place> places, std::size_t from, std::size_t count) {
  places.erase(places.begin() + static_cast<std::ptrdiff_t>(from),
               places.begin() + static_cast<std::ptrdiff_t>(from + count));
  return csv_text(places);
}

TEST(TrackFit, RefusesWithTheLine) {
  const auto good = stadium();
  auto outlier = good;
  outlier[20].y_m += 12.0;
  auto spike = good;
  spike[20].y_m += 4.0;
  std::string stations = "s_m,curvature_per_m,w_tr_right_m,w_tr_left_m\n";
  for (int i = 0; i < 200; ++i) stations += row_text(10.0 * i, i < 190 ? 0.003 : 0.0, 5.0, 5.0);
  struct Refusal {
    std::string text, place, reason;
  };
  const auto last = std::to_string(good.size() - 19);
  for (const Refusal& r : {
           Refusal{without(good, good.size() - 20, 20), "t.csv:" + last, "open loop"},
           Refusal{without(good, 60, 20), "t.csv:62", "a gap of"},
           Refusal{csv_text(good, 5.0, 119.9), "t.csv:", "to its inner wall"},
           Refusal{csv_text(spike), "t.csv:22", "beside the smoothed line"},
           Refusal{stations, "t.csv:201", "open loop: with stations the last row"},
       }) {
    const auto fit = fitted(r.text);
    ASSERT_FALSE(fit) << r.reason;
    EXPECT_EQ(fit.error().place.rfind(r.place, 0), 0u) << to_string(fit.error());
    EXPECT_NE(fit.error().what.find(r.reason), std::string::npos) << to_string(fit.error());
  }
}

}  // namespace
}  // namespace pitwall::track_file
