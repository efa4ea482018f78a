// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/trends.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pitwall::state {
namespace {

constexpr Duration kTick = milliseconds(20), kTarget = milliseconds(100);
constexpr Instant kStart{seconds(1'000).ns};

// One column, 50 a second: a slow wave, with a spike of 100 at the sample `spike`.
TrendTable wave(std::size_t samples, std::size_t spike) {
  TrendTable table(1);
  for (std::size_t i = 0; i < samples; ++i) {
    const double value = i == spike ? 100.0 : std::sin(0.01 * static_cast<double>(i));
    EXPECT_TRUE(table.note(kStart + static_cast<std::int64_t>(i) * kTick, {&value, 1}));
  }
  return table;
}

float largest(const std::vector<TrendPoint>& points) {
  float value = -1e9F;
  for (const TrendPoint& point : points)
    if (!std::isnan(point.value)) value = std::max(value, point.value);
  return value;
}

bool in_order(const std::vector<TrendPoint>& points) {
  return std::ranges::is_sorted(points, {}, [](const TrendPoint& p) { return p.time_s; });
}

TEST(Trends, GivesEverySampleOfTheLastMinutes) {
  const TrendTable table = wave(1'000, 500);
  const auto points = table.range(0, kStart, kStart + seconds(20), 20'000, kTarget);
  ASSERT_EQ(points.size(), 1'000u);
  EXPECT_TRUE(in_order(points));
  EXPECT_EQ(points[500].value, 100.0F);
  EXPECT_NEAR(points[1].time_s, 1'000.02, 1e-9);
}

TEST(Trends, AskingForFewLosesNoSpikeAndGivesNoMoreThanAsked) {
  const TrendTable table = wave(20'000, 7'777);
  for (const std::size_t asked : {3U, 10U, 100U, 1'000U}) {
    const auto points = table.range(0, kStart, kStart + seconds(400), asked, kTarget);
    EXPECT_LE(points.size(), asked);
    EXPECT_TRUE(in_order(points)) << asked;
    EXPECT_EQ(largest(points), 100.0F) << asked;
  }
}

TEST(Trends, WhatIsOlderThanTenMinutesKeepsItsSpikes) {
  const std::size_t half_hour = 90'000;
  const TrendTable table = wave(half_hour, 5);
  const auto points = table.range(0, kStart, kStart + seconds(1'800), 20'000, kTarget);
  EXPECT_EQ(largest(points), 100.0F);
  EXPECT_TRUE(in_order(points));
  EXPECT_NEAR(points.front().time_s, 1'000.0, 0.5);
}

TEST(Trends, MemoryIsBoundedHoweverLongItRuns) {
  const TrendTable two_hours = wave(360'000, 0);
  const std::size_t most = TrendCapacity{}.fine_rows * 12 + 7'200 * 16;
  EXPECT_LE(two_hours.filled_bytes(), most);
  const auto points = two_hours.range(0, kStart, kStart + seconds(7'200), 20'000, kTarget);
  EXPECT_NEAR(points.front().time_s, 1'000.0 + 3'600.0, 1.0) << "the last hour";
}

TEST(Trends, OfAWholeRecordingNothingIsDropped) {
  // Two hours and a half: the spans have become twice as long once.
  constexpr std::size_t kSamples = 450'000;
  TrendTable table(1, kWholeRecording);
  for (std::size_t i = 0; i < kSamples; ++i) {
    const double value = i == 7 ? 100.0 : i == 300'001 ? -50.0 : 1.0;
    table.note(kStart + static_cast<std::int64_t>(i) * kTick, {&value, 1});
  }
  EXPECT_LE(table.filled_bytes(), 36'000U * 16U + 12U);
  const auto all = table.range(0, kStart, kStart + seconds(9'000), 100'000, kTarget);
  EXPECT_TRUE(in_order(all));
  EXPECT_EQ(largest(all), 100.0F);
  EXPECT_NEAR(all.front().time_s, 1'000.0, 1e-9);
  EXPECT_NEAR(all.back().time_s, 1'000.0 + 9'000.0 - 0.02, 0.4);
  const auto spike = std::ranges::find(all, -50.0F, &TrendPoint::value);
  ASSERT_NE(spike, all.end());
  EXPECT_NEAR(spike->time_s, 1'000.0 + 6'000.02, 0.4) << "a span long now";
  EXPECT_TRUE(std::ranges::none_of(all, [](const TrendPoint& p) { return std::isnan(p.value); }));
}

TEST(Trends, AGapIsNoLine) {
  TrendTable table(1);
  const double value = 1.0;
  table.note(kStart, {&value, 1});
  table.note(kStart + seconds(10), {&value, 1});
  const auto points = table.range(0, kStart, kStart + seconds(20), 100, kTarget);
  ASSERT_EQ(points.size(), 3u);
  EXPECT_TRUE(std::isnan(points[1].value));
  EXPECT_EQ(points[1].quality, Quality::kStale);
  EXPECT_NEAR(points[1].time_s, 1'000.5, 1e-9);
}

TEST(Trends, ASampleCountsOnceAndNeverBackwards) {
  TrendTable table(1);
  const double value = 1.0;
  EXPECT_TRUE(table.note(kStart, {&value, 1}));
  EXPECT_FALSE(table.note(kStart, {&value, 1}));
  EXPECT_FALSE(table.note(kStart - kTick, {&value, 1}));
  EXPECT_EQ(table.range(0, kStart - seconds(1), kStart + seconds(1), 10, kTarget).size(), 1u);
  EXPECT_TRUE(table.range(0, kStart + seconds(1), kStart - seconds(1), 10, kTarget).empty());
}

TEST(Trends, FieldsAreFoundByTheirGroup) {
  Trends trends;
  telemetry::Snapshot state;
  state.values[telemetry::field("ego.vx")] = 50.0;
  state.at(telemetry::Group::kEgo) = kStart;
  telemetry::GroupSet groups;
  groups.add(telemetry::Group::kEgo);
  trends.note(state, groups);
  const auto of = [&](telemetry::FieldIndex field) {
    return trends.range(field, kStart, kStart + seconds(1), 10);
  };
  ASSERT_EQ(of(telemetry::field("ego.vx")).size(), 1u);
  EXPECT_EQ(of(telemetry::field("ego.vx"))[0].value, 50.0F);
  EXPECT_TRUE(std::isnan(of(telemetry::field("ego.x"))[0].value));
  EXPECT_TRUE(of(telemetry::field("tyres.pressure_rear_left")).empty());
}

}  // namespace
}  // namespace pitwall::state
