// SPDX-License-Identifier: Apache-2.0
#include "basestation/alarms/rate.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <random>

namespace pitwall::alarms {
namespace {

TEST(AlarmRate, CountsTheLastTenMinutes) {
  std::mt19937 random{3};
  AlarmRate rate;
  std::deque<Instant> truth;
  Instant now{};
  for (int i = 0; i < 20'000; ++i) {
    now += milliseconds(100 + static_cast<std::int64_t>(random() % 2'000));
    if (random() % 50 == 0) {
      rate.add(now);
      truth.push_back(now);
    }
    while (!truth.empty() && now - truth.front() >= kRateWindow) truth.pop_front();
    rate.advance(now);
    ASSERT_EQ(rate.per_10_min(), truth.size());
  }
}

TEST(AlarmRate, OneIsCountedForTheWindowAndQuietIsZero) {
  AlarmRate rate;
  Instant now{seconds(5'000).ns};
  rate.advance(now);
  EXPECT_EQ(rate.per_10_min(), 0U);
  rate.add(now);
  rate.advance(now + kRateWindow - nanoseconds(1));
  EXPECT_EQ(rate.per_10_min(), 1U);
  rate.advance(now + kRateWindow);
  EXPECT_EQ(rate.per_10_min(), 0U);
  rate.advance(now + 10 * kRateWindow);
  EXPECT_EQ(rate.per_10_min(), 0U);
}

TEST(AlarmRate, AFloodBeginsAboveTenAndIsOverAtFive) {
  AlarmRate rate;
  Instant now{};
  for (int i = 0; i < 10; ++i) {
    rate.add(now);
    EXPECT_FALSE(rate.advance(now));
    now += seconds(20);
  }
  EXPECT_FALSE(rate.flood());
  rate.add(now);
  EXPECT_TRUE(rate.advance(now));
  EXPECT_TRUE(rate.flood());
  int changes = 0;
  for (; rate.flood() && now < Instant{} + seconds(2'000); now += seconds(1)) {
    const std::size_t before = rate.per_10_min();
    changes += rate.advance(now) ? 1 : 0;
    EXPECT_TRUE(rate.flood() || before > kFloodOver);
  }
  EXPECT_EQ(changes, 1);
  EXPECT_EQ(rate.per_10_min(), kFloodOver);
}

TEST(AlarmRate, MoreThanItKeepsCountsAsAllOfThem) {
  AlarmRate rate;
  for (int i = 0; i < 1'000; ++i) rate.add(Instant{i});
  rate.advance(Instant{2'000});
  EXPECT_EQ(rate.per_10_min(), AlarmRate::kKept);
  EXPECT_EQ(rate.ever(), 1'000U);
}

}  // namespace
}  // namespace pitwall::alarms
