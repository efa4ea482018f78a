// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/replay/compare.hpp"

#include <gtest/gtest.h>

#include <random>

namespace pitwall::replay {
namespace {

constexpr Instant kBegin{seconds(77).ns};

std::vector<LoggedFrame> log_of(std::size_t count) {
  std::vector<LoggedFrame> log(count);
  for (std::size_t i = 0; i < count; ++i) {
    log[i].at = {kNanosecondsPerSecond * 1'700'000'000 + static_cast<std::int64_t>(i) * 400'000};
    log[i].frame.id = static_cast<std::uint32_t>(i % 2'000);
  }
  return log;
}

// Each frame at its time plus what `delay` says.
template <class Delay>
std::vector<can::ReceivedFrame> arrivals(const std::vector<LoggedFrame>& log, Delay delay) {
  std::vector<can::ReceivedFrame> out;
  for (const LoggedFrame& logged : log)
    out.push_back({logged.frame, kBegin + Duration{logged.at.ns - log[0].at.ns} + delay()});
  return out;
}

TEST(Compare, ADelayThatIsAlwaysTheSameIsNoError) {
  const auto log = log_of(3'000);
  const auto result = compare(log, arrivals(log, [] { return milliseconds(900); }));
  EXPECT_TRUE(result.complete());
  EXPECT_TRUE(result.in_order);
  ASSERT_TRUE(result.timing.has_value());
  EXPECT_EQ(result.timing->lateness.max_us, 0.0);
  EXPECT_EQ(result.timing->gap.max_us, 0.0);
}

TEST(Compare, ErrorsAreThoseThatWereMade) {
  // Every fourth frame late by 100 us, the others by 10: the zero is at 10.
  const auto log = log_of(4'000);
  int i = 0;
  const auto result =
      compare(log, arrivals(log, [&i] { return microseconds(++i % 4 == 0 ? 100 : 10); }));
  ASSERT_TRUE(result.timing.has_value());
  EXPECT_EQ(result.timing->lateness.p50_us, 0.0);
  EXPECT_EQ(result.timing->lateness.p90_us, 90.0);
  EXPECT_EQ(result.timing->gap.p50_us, 0.0);  // half of the gaps have a late frame at one end
  EXPECT_EQ(result.timing->gap.p90_us, 90.0);
}

TEST(Compare, WhatIsLostExtraOrMovedIsCounted) {
  const auto log = log_of(100);
  auto arrived = arrivals(log, [] { return Duration{}; });
  std::swap(arrived[10].frame, arrived[11].frame);
  auto result = compare(log, arrived);
  EXPECT_TRUE(result.complete());
  EXPECT_FALSE(result.in_order);
  EXPECT_FALSE(result.timing.has_value());
  arrived.erase(arrived.begin() + 50);
  arrived.push_back(arrived.back());
  arrived.push_back(arrived.back());
  result = compare(log, arrived);
  EXPECT_EQ(result.lost, 1U);
  EXPECT_EQ(result.extra, 2U);
  EXPECT_EQ(result.arrived, 101U);
  EXPECT_FALSE(result.complete());
  EXPECT_EQ(compare(log, {}).lost, 100U);
  arrived = arrivals(log, [] { return Duration{}; });
  arrived[5].frame.data[7] = 1;  // one changed frame is one lost and one extra
  result = compare(log, arrived);
  EXPECT_EQ(result.lost, 1U);
  EXPECT_EQ(result.extra, 1U);
}

TEST(Compare, AStampThatGoesBackIsDueWithTheOneBefore) {
  auto log = log_of(3);
  log[1].at = {log[0].at.ns - 5'000'000};
  std::vector<can::ReceivedFrame> arrived{
      {log[0].frame, kBegin}, {log[1].frame, kBegin}, {log[2].frame, kBegin + microseconds(800)}};
  const auto result = compare(log, arrived);
  ASSERT_TRUE(result.timing.has_value());
  EXPECT_EQ(result.timing->lateness.max_us, 0.0);
  EXPECT_EQ(result.timing->gap.max_us, 0.0);
}

TEST(Compare, MediansAreOfEachQuantileOnItsOwn) {
  const std::vector<Quantiles> runs{{1, 20, 300, 4'000}, {3, 10, 100, 9'000}, {2, 30, 200, 1}};
  const Quantiles middle = median_of(runs);
  EXPECT_EQ(middle.p50_us, 2.0);
  EXPECT_EQ(middle.p90_us, 20.0);
  EXPECT_EQ(middle.p99_us, 200.0);
  EXPECT_EQ(middle.max_us, 4'000.0);
  EXPECT_EQ(median_of(std::span(runs).first(2)).p50_us, 2.0);
  EXPECT_EQ(quantiles_of({}).max_us, 0.0);
}

}  // namespace
}  // namespace pitwall::replay
