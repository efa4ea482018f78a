// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace pitwall::sensors {
namespace {

constexpr int kDraws = 200'000;

TEST(Noise, NormalHasTheMomentsOfANormal) {
  Noise noise(7, 3);
  double sum = 0.0, squares = 0.0, fourths = 0.0;
  int beyond_two = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = noise.normal();
    sum += x, squares += x * x, fourths += x * x * x * x;
    beyond_two += std::abs(x) > 2.0 ? 1 : 0;
  }
  const double n = kDraws;
  EXPECT_NEAR(sum / n, 0.0, 5.0 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 1.0, 5.0 * std::sqrt(2.0 / n));
  EXPECT_NEAR(fourths / n, 3.0, 5.0 * std::sqrt(96.0 / n));
  EXPECT_NEAR(beyond_two / n, 0.0455, 0.003);
}

TEST(Noise, UniformFillsItsInterval) {
  Noise noise(1, 1);
  std::vector<int> bins(10);
  for (int i = 0; i < kDraws; ++i) {
    const double u = noise.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ++bins[static_cast<std::size_t>(u * 10.0)];
  }
  for (const int count : bins) EXPECT_NEAR(count, kDraws / 10, 5.0 * std::sqrt(kDraws / 10.0));
}

TEST(Noise, RepeatsForASeedAndNotForAnother) {
  Noise a(42, 0), b(42, 0), other_seed(43, 0), other_stream(42, 1);
  int same_seed = 0, same_stream = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto x = a.next();
    ASSERT_EQ(x, b.next());
    same_seed += x == other_seed.next() ? 1 : 0;
    same_stream += x == other_stream.next() ? 1 : 0;
  }
  EXPECT_EQ(same_seed + same_stream, 0);
}

TEST(Noise, StreamsAreUncorrelated) {
  Noise a(42, 0), b(42, 1);
  double product = 0.0;
  for (int i = 0; i < kDraws; ++i) product += a.normal() * b.normal();
  EXPECT_NEAR(product / kDraws, 0.0, 5.0 / std::sqrt(static_cast<double>(kDraws)));
}

}  // namespace
}  // namespace pitwall::sensors
