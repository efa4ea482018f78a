// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/outcome.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hil/bench/result.hpp"
#include "protocol/yaml/strict_map.hpp"
#include "tests/support/instants.hpp"

namespace pitwall::bench {
namespace {

TEST(Outcome, OfNothingIsNothing) {
  EXPECT_EQ(to_text(Outcome{}), "");
  EXPECT_EQ(to_json(Outcome{}), "null");
}

TEST(Outcome, KeepsTheEndAndTheNearestOfAnyDrive) {
  Outcome outcome;
  double nearest_m = 1e9, nearest_s = 0.0;
  for (int i = 0; i < 500; ++i) {
    const double t_s = 0.1 * i, gap_m = 3.0 + 2.0 * std::sin(0.37 * i) * std::cos(0.011 * i);
    if (gap_m < nearest_m) nearest_m = gap_m, nearest_s = t_s;
    follow(outcome, {.at = at_s(t_s),
                     .speed_mps = 60.0 - 0.12 * i,
                     .cross_track_m = -0.01 * i,
                     .wall_gap_m = gap_m});
  }
  EXPECT_EQ(outcome.last->at, at_s(49.9));
  EXPECT_EQ(outcome.nearest->wall_gap_m, nearest_m);
  EXPECT_EQ(outcome.nearest->at, at_s(nearest_s));
  EXPECT_NE(to_text(outcome).find("the car stands, 4.99 m from its line"), std::string::npos)
      << to_text(outcome);
}

TEST(Outcome, NothingAfterAContactCounts) {
  Outcome outcome;
  follow(outcome, {.at = at_s(1), .speed_mps = 60, .cross_track_m = 0, .wall_gap_m = 2});
  follow(outcome, {.at = at_s(2),
                   .speed_mps = 40,
                   .cross_track_m = 7,
                   .wall_gap_m = -0.1,
                   .s_m = 1234,
                   .left = true,
                   .contact = true});
  follow(outcome, {.at = at_s(3), .speed_mps = 0, .cross_track_m = 0, .wall_gap_m = 5});
  EXPECT_EQ(to_text(outcome), "the car hit the wall on the left at 2.00 s, s 1234 m, at 40.0 m/s");
  const auto document = yaml::load_text(to_json(outcome), "outcome.json");
  ASSERT_TRUE(document) << to_string(document.error());
  yaml::StrictMap map = document->root();
  EXPECT_TRUE(map.flag("contact"));
  EXPECT_EQ(map.map("end").number("at_s", 0, 100), 2.0);
  EXPECT_EQ(map.map("nearest_wall").number("wall_gap_m", -1, 1), -0.1);
}

}  // namespace
}  // namespace pitwall::bench
