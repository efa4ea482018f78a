// SPDX-License-Identifier: Apache-2.0
#include "hil/track_file/crossings.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/hil/track_file/csv_text.hpp"

namespace pitwall::track_file {
namespace {

TrackCsv csv_of(const std::vector<Place>& places, double right_m, double left_m) {
  const auto csv = read_track_csv(csv_text(places, right_m, left_m), "t.csv");
  EXPECT_TRUE(csv);
  return csv ? *csv : TrackCsv{};
}

std::optional<Crossing> crossing(const TrackCsv& csv) {
  std::vector<std::size_t> all(csv.rows.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return crossing_of(csv, all);
}

TEST(Crossings, ATrackHasNone) {
  EXPECT_FALSE(crossing(csv_of(stadium(), 10.0, 10.0)));
  EXPECT_FALSE(crossing(csv_of(stadium(0.5), 10.0, 10.0))) << "dense points";
  EXPECT_FALSE(crossing(csv_of(stadium(), 10.0, 110.0))) << "just inside of the turns' centres";
}

TEST(Crossings, AFigureOfEightCrossesItself) {
  std::vector<Place> places;
  for (int i = 0; i < 200; ++i) {
    const double a = 2.0 * std::numbers::pi * i / 200;
    places.push_back({400.0 * std::sin(a), 200.0 * std::sin(2.0 * a)});
  }
  const auto found = crossing(csv_of(places, 5.0, 5.0));
  ASSERT_TRUE(found);
  EXPECT_NE(found->what.find("the line crosses itself at line "), std::string::npos) << found->what;
}

// A waist: opposite sides of the lap come within 80 m of each other.
std::vector<Place> peanut() {
  std::vector<Place> places;
  for (int i = 0; i < 200; ++i) {
    const double a = 2.0 * std::numbers::pi * i / 200, r_m = 150.0 + 110.0 * std::cos(2.0 * a);
    places.push_back({r_m * std::cos(a), r_m * std::sin(a)});
  }
  return places;
}

TEST(Crossings, WallsThatMeetAreFoundOnEitherSide) {
  EXPECT_FALSE(crossing(csv_of(peanut(), 5.0, 35.0)));
  const auto left = crossing(csv_of(peanut(), 5.0, 45.0));
  ASSERT_TRUE(left);
  EXPECT_NE(left->what.find("the left wall crosses itself"), std::string::npos) << left->what;
  auto places = peanut();
  std::reverse(places.begin(), places.end());
  const auto right = crossing(csv_of(places, 45.0, 5.0));
  ASSERT_TRUE(right);
  EXPECT_NE(right->what.find("the right wall crosses itself"), std::string::npos) << right->what;
}

}  // namespace
}  // namespace pitwall::track_file
