// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/laps/recent_samples.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::state {
namespace {

constexpr Duration kGap = milliseconds(500);
Instant at(std::int64_t ms) { return Instant{milliseconds(ms).ns}; }

TEST(RecentSamples, BetweenTwoOfThemItIsLinear) {
  RecentSamples samples;
  EXPECT_FALSE(samples.value_at(at(0), kGap));
  samples.note(at(100), 10.0);
  samples.note(at(200), 20.0);
  EXPECT_FLOAT_EQ(*samples.value_at(at(100), kGap), 10.0F);
  EXPECT_FLOAT_EQ(*samples.value_at(at(130), kGap), 13.0F);
  EXPECT_FLOAT_EQ(*samples.value_at(at(200), kGap), 20.0F);
  EXPECT_FALSE(samples.value_at(at(201), kGap)) << "the next one has not come";
  EXPECT_TRUE(std::isnan(*samples.value_at(at(99), kGap)));
}

TEST(RecentSamples, AcrossAGapItIsUnknown) {
  RecentSamples samples;
  samples.note(at(0), 1.0);
  samples.note(at(501), 1.0);
  EXPECT_TRUE(std::isnan(*samples.value_at(at(300), kGap)));
  EXPECT_FLOAT_EQ(*samples.value_at(at(501), kGap), 1.0F);
}

TEST(RecentSamples, OnlyTheLastOnesAreKept) {
  RecentSamples samples;
  constexpr auto kMost = static_cast<std::int64_t>(RecentSamples::kKept);
  for (std::int64_t i = 0; i < 3 * kMost; ++i) {
    samples.note(at(20 * i), static_cast<double>(i));
    samples.note(at(20 * i - 10), 1e9);  // not newer
  }
  EXPECT_FLOAT_EQ(*samples.value_at(at(40 * kMost + 10), kGap), 2.0F * kMost + 0.5F);
  EXPECT_TRUE(std::isnan(*samples.value_at(at(40 * kMost - 10), kGap)));
}

}  // namespace
}  // namespace pitwall::state
