// SPDX-License-Identifier: Apache-2.0
#include "hil/report/signal_series.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/hil/report/some_signals.hpp"

namespace pitwall::report {
namespace {

TEST(SignalSeries, ValuesAreThoseThatWereWrittenAndTimeIsFromTheEarliestFrame) {
  const can::Database database = some_database();
  replay::CanLog log = some_log();
  std::swap(log.frames.front(), log.frames[40]);  // the earliest frame does not come first
  const auto series = signal_series(log, {{some_signal(database, "Drive", "Speed")}}, {0.0, 100.0});
  ASSERT_EQ(series.size(), 1u);
  EXPECT_EQ(series[0].name(), "Drive.Speed");
  EXPECT_EQ(series[0].values, kSomeFrames);
  ASSERT_EQ(series[0].points.size(), kSomeFrames);
  for (std::size_t i = 0; i < kSomeFrames; ++i) {
    EXPECT_NEAR(series[0].points[i].x, 0.01 * static_cast<double>(i), 1e-9);
    EXPECT_NEAR(series[0].points[i].y, speed_at(i), 1e-9) << i;
  }
}

TEST(SignalSeries, AMultiplexedSignalIsThereOnlyWhereItIsPresent) {
  const can::Database database = some_database();
  const auto series =
      signal_series(some_log(), {{some_signal(database, "Drive", "Odd")}}, {0.0, 100.0});
  EXPECT_EQ(series[0].values, kSomeFrames / 2);
  EXPECT_EQ(series[0].absent, kSomeFrames / 2);
  for (const Point& point : series[0].points) EXPECT_EQ(point.y, 7.0);
}

TEST(SignalSeries, APauseOfMoreThanFivePeriodsIsAGap) {
  const can::Database database = some_database();
  const std::vector<ChosenSignal> chosen{some_signal(database, "Drive", "Speed")};
  for (const double pause_s : {0.04, 0.2}) {
    replay::CanLog log = some_log();
    for (std::size_t i = 50; i < log.frames.size(); ++i)
      log.frames[i].at.ns += static_cast<std::int64_t>(pause_s * 1e9);
    const auto series = signal_series(log, chosen, {0.0, 100.0});
    const auto gaps = std::ranges::count_if(series[0].points,
                                            [](const Point& point) { return std::isnan(point.y); });
    EXPECT_EQ(gaps, pause_s > 0.1 ? 1 : 0) << pause_s;
  }
}

TEST(SignalSeries, EachChannelHasItsOwnLineAndOneCanBeChosen) {
  const can::Database database = some_database();
  replay::CanLog log = some_log();
  log.channels = {"can0", "can1"};
  for (std::size_t i = 0; i < 30; ++i) log.frames[i].channel = 1;
  const std::vector<ChosenSignal> chosen{some_signal(database, "Drive", "Speed")};
  const auto both = signal_series(log, chosen, {0.0, 100.0});
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].name(), "Drive.Speed (can0)");
  EXPECT_EQ(both[0].values, kSomeFrames - 30);
  EXPECT_EQ(both[1].values, 30u);
  const auto one = signal_series(log, chosen, {0.0, 100.0, "can1"});
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].values, 30u);
}

TEST(SignalSeries, OnlyThePartThatIsWanted) {
  const can::Database database = some_database();
  const auto series =
      signal_series(some_log(), {{some_signal(database, "Drive", "Speed")}}, {0.195, 0.305});
  EXPECT_EQ(series[0].values, 11u);
  EXPECT_NEAR(series[0].points.front().x, 0.2, 1e-9);
}

TEST(SignalSeries, WhatGivesNoPointIsCounted) {
  const can::Database database = some_database();
  replay::CanLog log = some_log();
  log.frames[3].frame.length = 7;
  log.frames[4].frame.remote = true;
  const auto speed = signal_series(log, {{some_signal(database, "Drive", "Speed")}}, {0.0, 100.0});
  EXPECT_EQ(speed[0].other_frames, 2u);
  EXPECT_EQ(speed[0].values, kSomeFrames - 2);
  const auto never = signal_series(log, {{some_signal(database, "Silent", "Value")}}, {0.0, 100.0});
  ASSERT_EQ(never.size(), 1u);
  EXPECT_TRUE(never[0].points.empty());

  replay::LoggedFrame wild = log.frames[0];
  wild.frame.id = 0x20;
  wild.frame.data.fill(0);
  for (const double value : {std::nan(""), std::numeric_limits<double>::infinity(), 1e101, 2.5}) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (std::size_t i = 0; i < 8; ++i)
      wild.frame.data[i] = static_cast<std::uint8_t>(bits >> 8 * i);
    log.frames.push_back(wild);
  }
  const auto real = signal_series(log, {{some_signal(database, "Wild", "Real")}}, {0.0, 100.0});
  EXPECT_EQ(real[0].not_drawn, 3u);
  EXPECT_EQ(real[0].values, 1u);
}

TEST(SignalSeries, ALogWithoutFramesHasNoSpan) {
  const can::Database database = some_database();
  EXPECT_EQ(span_of({}).length_s, 0.0);
  EXPECT_EQ(signal_series({}, {{some_signal(database, "Drive", "Speed")}}, {0.0, 1.0})[0].values,
            0u);
}

}  // namespace
}  // namespace pitwall::report
