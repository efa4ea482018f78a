// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/ingress/arrivals.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::io {
namespace {

constexpr Instant kStart{seconds(100).ns};

TEST(Arrivals, NothingIsKnownBeforeTheFirst) {
  const Arrivals arrivals;
  const ArrivalFigures figures = arrivals.newest(kStart);
  EXPECT_TRUE(std::isnan(figures.rate_hz) && std::isnan(figures.gap_ms) &&
              std::isnan(figures.latency_ms));
}

// A computer's drivers need their time; one that never comes is a sensor at 0 Hz.
TEST(SensorFigures, ASensorThatNeverComesHasTheRateZeroOnceItWasAwaited) {
  Arrivals arrivals;
  const auto rate_hz = [&](Duration since_start) {
    return SensorFigures{arrivals, 7, kStart, kStart + since_start}.arrivals.rate_hz;
  };
  constexpr Duration kJustBefore = SensorFigures::kAwaited - milliseconds(1);
  EXPECT_TRUE(std::isnan(rate_hz(Duration{})));
  EXPECT_TRUE(std::isnan(rate_hz(kJustBefore)));
  EXPECT_EQ(rate_hz(SensorFigures::kAwaited), 0.0);
  arrivals.note(kStart + SensorFigures::kAwaited, {});
  EXPECT_EQ(rate_hz(SensorFigures::kAwaited), 1.0);
  EXPECT_EQ((SensorFigures{arrivals, 7, kStart, kStart}.drops), 7U);
}

TEST(Arrivals, AnEvenStreamHasItsRateItsPeriodAndItsLatency) {
  Arrivals arrivals;
  Instant now = kStart;
  for (int i = 0; i < 100; ++i) arrivals.note(now += milliseconds(50), milliseconds(12));
  const ArrivalFigures figures = arrivals.newest(now);
  EXPECT_EQ(figures.rate_hz, 20.0);
  EXPECT_EQ(figures.gap_ms, 50.0);
  EXPECT_EQ(figures.latency_ms, 12.0);
  EXPECT_EQ(arrivals.count(), 100U);
}

// Twenty in a second, and yet nothing for half of it.
TEST(Arrivals, AGapShowsAlthoughTheRateIsRight) {
  Arrivals arrivals;
  Instant now = kStart;
  for (int i = 0; i < 20; ++i) arrivals.note(now += milliseconds(50), {});
  now += milliseconds(500);
  for (int i = 0; i < 20; ++i) arrivals.note(now += milliseconds(20), {});
  EXPECT_GE(arrivals.newest(now).rate_hz, 20.0);
  EXPECT_EQ(arrivals.newest(now).gap_ms, 520.0);
}

TEST(Arrivals, OneLateSampleShowsForASecond) {
  Arrivals arrivals;
  Instant now = kStart;
  arrivals.note(now += milliseconds(50), milliseconds(300));
  for (int i = 0; i < 10; ++i) arrivals.note(now += milliseconds(50), milliseconds(5));
  EXPECT_EQ(arrivals.newest(now).latency_ms, 300.0);
  for (int i = 0; i < 15; ++i) arrivals.note(now += milliseconds(50), milliseconds(5));
  EXPECT_EQ(arrivals.newest(now).latency_ms, 5.0);
}

TEST(Arrivals, SilenceIsSeenAlthoughNothingArrives) {
  Arrivals arrivals;
  Instant now = kStart;
  for (int i = 0; i < 40; ++i) arrivals.note(now += milliseconds(50), milliseconds(5));
  EXPECT_EQ(arrivals.newest(now + milliseconds(300)).gap_ms, 300.0);
  EXPECT_EQ(arrivals.newest(now + seconds(2)).rate_hz, 0.0);
  EXPECT_TRUE(std::isnan(arrivals.newest(now + seconds(2)).latency_ms));
}

TEST(Arrivals, AVeryFastStreamIsBoundedAndStillCounted) {
  Arrivals arrivals;
  Instant now = kStart;
  for (int i = 0; i < 5'000; ++i) arrivals.note(now += microseconds(100), {});
  EXPECT_EQ(arrivals.count(), 5'000U);
  EXPECT_EQ(arrivals.newest(now).rate_hz, static_cast<double>(Arrivals::kKept));
}

}  // namespace
}  // namespace pitwall::io
