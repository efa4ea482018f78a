// SPDX-License-Identifier: Apache-2.0
#include "protocol/vocabulary/quantile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "protocol/vocabulary/random.hpp"

namespace pitwall {
namespace {

constexpr double kShares[] = {1e-9, 0.01, 0.25, 0.5, 0.9, 0.99, 0.999, 1.0};

// The definition itself, by counting.
double least_that_covers(const std::vector<double>& samples, double share) {
  double least = std::numeric_limits<double>::infinity();
  for (const double sample : samples) {
    const auto covered = std::ranges::count_if(samples, [&](double s) { return s <= sample; });
    if (static_cast<double>(covered) >= share * static_cast<double>(samples.size()))
      least = std::min(least, sample);
  }
  return least;
}

TEST(NearestRank, IsTheLeastSampleThatCoversTheShare) {
  Random random{3};
  for (const std::size_t count : {1UL, 2UL, 3UL, 10UL, 99UL, 100UL, 101UL}) {
    std::vector<double> samples(count);
    for (double& sample : samples) sample = static_cast<double>(random.below(30));
    std::ranges::sort(samples);
    for (const double share : kShares)
      EXPECT_EQ(samples[nearest_rank(share, count)], least_that_covers(samples, share))
          << count << " samples, " << share;
  }
}

TEST(Histogram, HasTheQuantilesOfItsSamplesToOneCell) {
  Random random{5};
  Histogram histogram{1'000};
  EXPECT_EQ(histogram.quantile(0.5), 0.0);
  std::vector<double> samples;
  for (int i = 0; i < 5'000; ++i) {
    samples.push_back(random.between(0.0, 900.0));
    histogram.add(samples.back());
  }
  std::ranges::sort(samples);
  EXPECT_EQ(histogram.count(), samples.size());
  for (const double share : kShares) {
    const double exact = samples[nearest_rank(share, samples.size())];
    EXPECT_GE(histogram.quantile(share), exact) << share;
    EXPECT_LE(histogram.quantile(share), exact + 1.0) << share;
  }
}

TEST(Histogram, WhatLiesOutsideIsInTheCellsAtTheEnds) {
  Histogram histogram{10};
  histogram.add(-5.0);
  EXPECT_EQ(histogram.quantile(1.0), 1.0);
  histogram.add(1e300);
  EXPECT_EQ(histogram.quantile(1.0), 10.0);
  EXPECT_EQ(histogram.quantile(0.5), 1.0);
}

}  // namespace
}  // namespace pitwall
