// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/clusters/clusters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "tests/support/draw.hpp"

namespace pitwall::perception {
namespace {

using Points = std::vector<PlanePoint>;

// By its definition: all that can be reached from a point, step by step.
std::set<Indices> by_definition(const Points& points, double reach_m, std::size_t least) {
  std::set<Indices> found;
  std::vector<bool> is_taken(points.size(), false);
  for (std::size_t start = 0; start < points.size(); ++start) {
    if (is_taken[start]) continue;
    std::vector<std::size_t> open{start};
    Indices cluster;
    is_taken[start] = true;
    while (!open.empty()) {
      const std::size_t i = open.back();
      open.pop_back();
      cluster.push_back(static_cast<std::uint32_t>(i));
      for (std::size_t j = 0; j < points.size(); ++j) {
        const double apart_m =
            std::hypot(points[i].x_m - points[j].x_m, points[i].y_m - points[j].y_m);
        if (is_taken[j] || apart_m > reach_m) continue;
        is_taken[j] = true;
        open.push_back(j);
      }
    }
    std::ranges::sort(cluster);
    if (cluster.size() >= least) found.insert(cluster);
  }
  return found;
}

TEST(Clusters, AreThoseOfTheDefinition) {
  std::mt19937_64 random{7};
  const auto anywhere = [&] { return testing::draw_uniform(random, -12.0, 12.0); };
  for (const std::size_t count : {0U, 1U, 10U, 100U, 400U, 900U}) {
    Points points;
    for (std::size_t i = 0; i < count; ++i) points.push_back({anywhere(), anywhere()});
    for (const double reach_m : {0.2, 0.5, 1.0}) {
      const auto found = clusters_of(points, {.reach_m = reach_m, .points_least = 3});
      EXPECT_EQ(std::set<Indices>(found.begin(), found.end()), by_definition(points, reach_m, 3))
          << count << " points, " << reach_m << " m";
    }
  }
}

// What stands for a cell of 0.5 m is clustered as by the definition, and takes the rest along.
TEST(Clusters, OfBundlesAreThoseOfTheirFirstPoints) {
  std::mt19937_64 random{11};
  const auto anywhere = [&] { return testing::draw_uniform(random, -12.0, 12.0); };
  Points points;
  for (int i = 0; i < 3000; ++i) points.push_back({anywhere(), anywhere()});
  constexpr double kBundle_m = 0.5, kReach_m = 0.7;
  std::map<std::pair<double, double>, std::size_t> bundle_in;
  Points firsts;
  std::vector<Indices> bundles;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const std::pair cell{std::floor(points[i].x_m / kBundle_m),
                         std::floor(points[i].y_m / kBundle_m)};
    const auto [at, is_new] = bundle_in.try_emplace(cell, bundles.size());
    if (is_new) firsts.push_back(points[i]), bundles.emplace_back();
    bundles[at->second].push_back(i);
  }
  std::set<Indices> expected;
  for (const Indices& of_firsts : by_definition(firsts, kReach_m, 1)) {
    Indices all;
    for (const std::uint32_t k : of_firsts)
      all.insert(all.end(), bundles[k].begin(), bundles[k].end());
    std::ranges::sort(all);
    if (all.size() >= 3) expected.insert(all);
  }
  ASSERT_GT(expected.size(), 1U);
  const auto found =
      clusters_of(points, {.reach_m = kReach_m, .bundle_m = kBundle_m, .points_least = 3});
  EXPECT_EQ(std::set<Indices>(found.begin(), found.end()), expected);
}

ClusterRule rule(std::size_t points_least, double weight_least = 0.0) {
  return {
      .reach_m = 0.6, .points_least = points_least, .cell_m = 0.5, .weight_least = weight_least};
}

TEST(Clusters, ComeByTheirFirstPoint) {
  const Points points{{9.0, 9.0}, {1.0, 1.0}, {9.1, 9.1}, {1.1, 1.1}, {5.0, 5.0}};
  EXPECT_EQ(clusters_of(points, rule(1)), (std::vector<Indices>{{0, 2}, {1, 3}, {4}}));
  EXPECT_EQ(clusters_of(points, rule(2)), (std::vector<Indices>{{0, 2}, {1, 3}}));
}

TEST(Clusters, ThinCellsAreLeftOutAndJoinNothing) {
  // Two full cells with a thin one between them.
  const Points points{{0.1, 0.1}, {0.2, 0.2}, {0.7, 0.1}, {1.1, 0.1}, {1.2, 0.2}};
  EXPECT_EQ(clusters_of(points, rule(1)).size(), 1U);
  EXPECT_EQ(clusters_of(points, rule(1, 2.0)), (std::vector<Indices>{{0, 1}, {3, 4}}));
  const std::vector<float> weights{1.0F, 1.0F, 2.0F, 0.9F, 1.0F};
  EXPECT_EQ(clusters_of(points, rule(1, 2.0), weights), (std::vector<Indices>{{0, 1, 2}}));
}

}  // namespace
}  // namespace pitwall::perception
