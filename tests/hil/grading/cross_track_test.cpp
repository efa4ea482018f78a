// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/cross_track.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace pitwall::grading {
namespace {

TEST(CrossTrack, BracketsTileTheSpeedsAboveTen) {
  for (std::size_t i = 1; i < kBrackets.size(); ++i)
    EXPECT_EQ(kBrackets[i].to_mps, kBrackets[i - 1].from_mps);
  EXPECT_EQ(kBrackets.back().from_mps, 10.0);
}

TEST(CrossTrack, AgreesWithAPlainComputation) {
  std::mt19937 engine{9};
  const auto unit = [&] { return static_cast<double>(engine() % 100'001) / 100'000.0; };
  CrossTrack statistics;
  std::vector<std::pair<double, double>> ticks;
  for (int i = 0; i < 20'000; ++i) {
    ticks.emplace_back(80.0 * unit(), 3.0 * unit() - 1.5);
    add(statistics, ticks.back().first, ticks.back().second);
  }
  std::uint64_t samples = statistics.slow;
  for (std::size_t b = 0; b < kBrackets.size(); ++b) {
    double sum = 0.0, most = 0.0;
    std::uint64_t n = 0;
    for (const auto& [v, e] : ticks) {
      if (v < kBrackets[b].from_mps || v >= kBrackets[b].to_mps) continue;
      sum += std::abs(e);
      most = std::max(most, std::abs(e));
      ++n;
    }
    EXPECT_EQ(statistics.by_bracket[b].samples, n);
    EXPECT_DOUBLE_EQ(statistics.by_bracket[b].mean_m(), sum / static_cast<double>(n));
    EXPECT_EQ(statistics.by_bracket[b].max_m, most);
    samples += n;
  }
  EXPECT_EQ(samples, ticks.size());
  EXPECT_EQ(statistics.overall.samples, samples - statistics.slow);
}

TEST(CrossTrack, EachLapHasItsOwnMeanAndMaximum) {
  CrossTrack statistics;
  add(statistics, 30.0, 0.4, 0);
  add(statistics, 30.0, -0.2, 2);
  add(statistics, 40.0, 0.1, 2);
  add(statistics, 5.0, 9.0, 2);  // too slow to count
  ASSERT_EQ(statistics.by_lap.size(), 3U);
  EXPECT_EQ(statistics.by_lap[0].samples, 1U);
  EXPECT_EQ(statistics.by_lap[1].samples, 0U);
  EXPECT_DOUBLE_EQ(statistics.by_lap[2].mean_m(), 0.15);
  EXPECT_EQ(statistics.by_lap[2].max_m, 0.2);
  EXPECT_NE(
      to_table(statistics).find("by lap, mean and max: 0.400 0.400; nan 0.000; 0.150 0.200\n"),
      std::string::npos)
      << to_table(statistics);
}

TEST(CrossTrack, TheSignDoesNotMatterAndANaNIsOnlyCounted) {
  CrossTrack a, b;
  add(a, 30.0, 0.4);
  add(b, 30.0, -0.4);
  EXPECT_EQ(a.by_bracket[6].sum_m, b.by_bracket[6].sum_m);
  EXPECT_EQ(a.by_bracket[6].samples, 1U);  // the edge belongs to the faster bracket
  add(a, kUnset, 0.1);
  add(a, 30.0, kUnset);
  EXPECT_EQ(a.undefined, 2U);
  EXPECT_EQ(a.overall.samples, 1U);
  EXPECT_TRUE(std::isnan(CrossTrack{}.overall.mean_m()));
}

TEST(CrossTrack, TheTableHasOneLinePerBracketAndThePaperBesideIt) {
  CrossTrack statistics;
  add(statistics, 62.0, 0.25);
  const std::string table = to_table(statistics);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'),
            static_cast<std::ptrdiff_t>(kBrackets.size() + 2));
  EXPECT_NE(table.find(">60              1    0.250    0.250       0.540       0.689"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("all >10          1    0.250    0.250       0.244       0.372"),
            std::string::npos)
      << table;
}

}  // namespace
}  // namespace pitwall::grading
