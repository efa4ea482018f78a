// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/association.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/draw.hpp"

namespace pitwall::tracking {
namespace {

using pitwall::testing::draw_uniform;

Costs costs_of(std::size_t tracks, std::size_t detections) {
  Costs c;
  c.tracks = tracks, c.detections = detections;
  for (auto& row : c.cost) row.fill(Costs::kOutside);
  return c;
}

struct Sum {
  std::size_t pairs = 0;
  double cost = 0.0;
};

Sum sum_of(const Costs& c, const Assignment& a) {
  Sum sum;
  for (std::size_t t = 0; t < c.tracks; ++t)
    if (a.of_track[t] != kNone) ++sum.pairs, sum.cost += c.cost[t][a.of_track[t]];
  return sum;
}

void expect_valid(const Costs& c, const Assignment& a) {
  for (std::size_t t = 0; t < c.tracks; ++t) {
    if (a.of_track[t] == kNone) continue;
    ASSERT_LT(a.of_track[t], c.detections);
    EXPECT_TRUE(std::isfinite(c.cost[t][a.of_track[t]]));
    EXPECT_EQ(a.of_detection[a.of_track[t]], t);
  }
}

TEST(Association, GreedyTakesTheLeastFirst) {
  Costs c = costs_of(2, 2);
  c.cost[0] = {1.0, 2.0}, c.cost[1] = {1.5, 9.0};
  c.cost[0][2] = c.cost[1][2] = Costs::kOutside;
  const Assignment greedy = assign(c, Search::kGreedy);
  EXPECT_EQ(greedy.of_track[0], 0);
  EXPECT_EQ(greedy.of_track[1], 1);
  const Assignment best = assign(c, Search::kBestTwo);  // 3.5 instead of 10
  EXPECT_EQ(best.of_track[0], 1);
  EXPECT_EQ(best.of_track[1], 0);
}

TEST(Association, TrackGivesWayToOneThatHasNoOther) {
  Costs c = costs_of(2, 2);
  c.cost[0][0] = 1.0, c.cost[0][1] = 2.0, c.cost[1][0] = 3.0;
  EXPECT_EQ(sum_of(c, assign(c, Search::kGreedy)).pairs, 1U);
  EXPECT_EQ(sum_of(c, assign(c, Search::kBestTwo)).pairs, 2U);
}

TEST(Association, NothingOutsideOfTheGateIsAssigned) {
  const Costs c = costs_of(3, 4);
  EXPECT_EQ(sum_of(c, assign(c, Search::kBestTwo)).pairs, 0U);
}

// Of two tracks and two detections the best assignment is known: both are tried.
TEST(Association, OfTwoAndTwoItIsTheBest) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 2000; ++k) {
    Costs c = costs_of(2, 2);
    for (std::size_t t = 0; t < 2; ++t)
      for (std::size_t d = 0; d < 2; ++d)
        if (draw_uniform(random) < 0.8) c.cost[t][d] = draw_uniform(random, -5.0, 16.0);
    const Assignment a = assign(c, Search::kBestTwo);
    expect_valid(c, a);
    const double straight = c.cost[0][0] + c.cost[1][1], crossed = c.cost[0][1] + c.cost[1][0];
    const double best = std::min(straight, crossed);
    if (std::isfinite(best)) {
      EXPECT_EQ(sum_of(c, a).pairs, 2U);
      EXPECT_DOUBLE_EQ(sum_of(c, a).cost, best);
    }
  }
}

// With any number, the better search is never worse, and full tables end.
TEST(Association, BestOfTwoIsNeverWorseThanGreedy) {
  std::mt19937_64 random(2);
  for (int k = 0; k < 300; ++k) {
    Costs c = costs_of(kTracksMax, kMeasurementsMax);
    for (std::size_t t = 0; t < c.tracks; ++t)
      for (std::size_t d = 0; d < c.detections; ++d)
        if (draw_uniform(random) < 0.3) c.cost[t][d] = draw_uniform(random, -5.0, 16.0);
    const Assignment greedy = assign(c, Search::kGreedy), best = assign(c, Search::kBestTwo);
    expect_valid(c, greedy), expect_valid(c, best);
    const Sum a = sum_of(c, greedy), b = sum_of(c, best);
    EXPECT_GE(b.pairs, a.pairs);
    if (b.pairs == a.pairs) {
      EXPECT_LE(b.cost, a.cost + 1e-9);
    }
  }
}

}  // namespace
}  // namespace pitwall::tracking
