// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/lateness_histogram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace pitwall::replay {
namespace {

TEST(LatenessHistogram, QuantilesAreThoseOfTheSortedSamples) {
  std::mt19937_64 random(41);
  LatenessHistogram histogram;
  std::vector<std::int64_t> samples_ns;
  for (int i = 0; i < 5'000; ++i) {
    samples_ns.push_back(static_cast<std::int64_t>(random() % 15'000'000) - 20'000);
    histogram.add({samples_ns.back()});
  }
  std::sort(samples_ns.begin(), samples_ns.end());
  EXPECT_EQ(histogram.earliest().ns, samples_ns.front());
  EXPECT_EQ(histogram.latest().ns, samples_ns.back());
  for (const double share : {0.01, 0.5, 0.9, 0.99, 1.0}) {
    const auto index =
        static_cast<std::size_t>(std::ceil(share * static_cast<double>(samples_ns.size()))) - 1;
    const std::int64_t exact_ns = std::max<std::int64_t>(samples_ns[index], 0);
    EXPECT_GT(histogram.quantile(share).ns, exact_ns);
    EXPECT_LE(histogram.quantile(share).ns, exact_ns + 1'000);
  }
  for (int i = 0; i < 100'000; ++i) histogram.add(seconds(3));
  EXPECT_EQ(histogram.quantile(0.9),
            seconds(3));  // beyond the last cell: the maximum stands for it
}

TEST(LatenessHistogram, EmptyIsZero) { EXPECT_EQ(LatenessHistogram{}.quantile(0.5), Duration{}); }

}  // namespace
}  // namespace pitwall::replay
