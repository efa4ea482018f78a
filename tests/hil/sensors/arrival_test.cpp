// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/arrival.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pitwall::sensors {
namespace {

TEST(Arrival, AnEpochComesOnceHoweverLateTheCall) {
  Instant next{};
  EXPECT_TRUE(due(Instant{}, milliseconds(50), next));
  EXPECT_FALSE(due(Instant{} + milliseconds(49), milliseconds(50), next));
  EXPECT_TRUE(due(Instant{} + milliseconds(175), milliseconds(50), next));
  EXPECT_EQ(next, Instant{} + milliseconds(200));
}

// The jitter is exponential and cut at six means: its mean is (1 - e^-6) of the uncut one, its
// sigma below one mean, so that the mean of n draws lies within 5 / sqrt(n) means.
TEST(Arrival, LatencyHasTheMeanOfItsJitterAndNeverLess) {
  constexpr int kDraws = 100'000;
  const Cadence cadence{milliseconds(50), milliseconds(90), 0.010};
  Noise noise(5, 5);
  double sum_s = 0.0, most_s = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const Duration takes = latency(cadence, noise);
    ASSERT_GE(takes, cadence.latency);
    sum_s += (takes - cadence.latency).seconds();
    most_s = std::max(most_s, (takes - cadence.latency).seconds());
  }
  const double expected_s = cadence.jitter_mean_s * (1.0 - std::exp(-kJitterMax));
  EXPECT_NEAR(sum_s / kDraws, expected_s, 5.0 * cadence.jitter_mean_s / std::sqrt(kDraws));
  EXPECT_NEAR(most_s, kJitterMax * cadence.jitter_mean_s, 1e-9);
}

}  // namespace
}  // namespace pitwall::sensors
