// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/timeline.hpp"

#include <gtest/gtest.h>

namespace pitwall::replay {
namespace {

CanLog log_of(const std::vector<std::pair<std::int64_t, std::uint8_t>>& stamps_us) {
  CanLog log;
  log.channels = {"can0", "can1"};
  for (const auto& [us, channel] : stamps_us) {
    LoggedFrame f;
    f.at = {1'700'000'000 * kNanosecondsPerSecond + us * 1'000};
    f.channel = channel;
    f.frame.id = static_cast<std::uint32_t>(log.frames.size());
    log.frames.push_back(f);
  }
  return log;
}

TEST(Timeline, EachBusKeepsTheOrderOfTheLog) {
  const auto t = make_timeline(log_of({{0, 0}, {10, 1}, {10, 0}, {5, 1}, {30, 0}}), {});
  ASSERT_TRUE(t.has_value());
  ASSERT_EQ(t->buses.size(), 2U);
  EXPECT_EQ(t->buses[0].interface, "can0");
  EXPECT_EQ(t->buses[0].due, (std::vector<Duration>{{0}, microseconds(10), microseconds(30)}));
  // The stamp that goes back is due with the one before it.
  EXPECT_EQ(t->buses[1].due, (std::vector<Duration>{microseconds(10), microseconds(10)}));
  EXPECT_EQ(t->buses[1].frames[1].id, 3U);
  EXPECT_EQ(t->frames, 5U);
}

TEST(Timeline, SpeedScalesFromTheStartSoNothingDrifts) {
  std::vector<std::pair<std::int64_t, std::uint8_t>> stamps;
  for (std::int64_t i = 0; i < 10'000; ++i) stamps.emplace_back(i * 1'000, 0);
  const auto t = make_timeline(log_of(stamps), {.speed = 3.0});
  ASSERT_TRUE(t.has_value());
  for (std::int64_t i = 0; i < 10'000; ++i) {
    const std::int64_t exact_ns = i * 1'000'000 / 3;
    ASSERT_LE(std::abs(t->buses[0].due[static_cast<std::size_t>(i)].ns - exact_ns), 1) << i;
  }
  // The next pass begins one mean gap after the last frame.
  EXPECT_NEAR(static_cast<double>(t->pass.ns), 10'000 * 1e6 / 3.0, 2.0);
}

TEST(Timeline, ChannelsGoWhereTheyAreSent) {
  const auto log = log_of({{0, 0}, {1, 1}, {2, 0}});
  const auto merged = make_timeline(log, {.interface = "vcan0"});
  ASSERT_TRUE(merged.has_value());
  ASSERT_EQ(merged->buses.size(), 1U);
  EXPECT_EQ(merged->buses[0].frames.size(), 3U);
  const auto mapped = make_timeline(log, {.interface = "vcan0", .map = {{"can1", "vcan5"}}});
  ASSERT_TRUE(mapped.has_value());
  ASSERT_EQ(mapped->buses.size(), 2U);
  EXPECT_EQ(mapped->buses[0].interface, "vcan0");
  EXPECT_EQ(mapped->buses[1].interface, "vcan5");
}

TEST(Timeline, WhatCannotBePlayedIsAProblem) {
  EXPECT_FALSE(make_timeline(CanLog{}, {}).has_value());
  const auto log = log_of({{0, 0}});
  for (const double speed : {0.0, -1.0, 1e-4, 1e7, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_FALSE(make_timeline(log, {.speed = speed}).has_value()) << speed;
  const auto unknown = make_timeline(log, {.map = {{"can9", "vcan0"}}});
  ASSERT_FALSE(unknown.has_value());
  EXPECT_EQ(unknown.error().place, "can9");
}

TEST(Timeline, WhatIsLeftOutTakesNoTime) {
  // Frames at 0, 1, 2 s, then a gap of an hour, then 1 s more.
  const auto log =
      log_of({{0, 0}, {1'000'000, 0}, {2'000'000, 1}, {3'602'000'000, 0}, {3'603'000'000, 0}});
  const auto late = make_timeline(log, {.interface = "v", .start = milliseconds(1'500)});
  ASSERT_TRUE(late.has_value());
  EXPECT_EQ(late->frames, 3U);
  EXPECT_EQ(late->buses[0].due[0], Duration{});  // it begins with its first frame
  EXPECT_EQ(late->buses[0].due[1], seconds(3'600));
  const auto skipped = make_timeline(log, {.interface = "v", .longest_gap = seconds(10)});
  ASSERT_TRUE(skipped.has_value());
  EXPECT_EQ(skipped->buses[0].due,
            (std::vector<Duration>{{}, seconds(1), seconds(2), seconds(2), seconds(3)}));
  const auto chosen = make_timeline(log, {.interface = "v", .ids = {1, 3}});
  ASSERT_TRUE(chosen.has_value());
  ASSERT_EQ(chosen->frames, 2U);
  EXPECT_EQ(chosen->buses[0].frames[1].id, 3U);
  EXPECT_EQ(chosen->buses[0].due[1], seconds(3'601));
  EXPECT_FALSE(make_timeline(log, {.ids = {77}}).has_value());
  EXPECT_FALSE(make_timeline(log, {.start = seconds(4'000)}).has_value());
}

TEST(Timeline, APassLongerThanAYearIsAProblemUnlessItsGapIsSkipped) {
  CanLog log = log_of({{0, 0}, {1, 0}});
  log.frames[0].at = {};  // the recorder's clock was not set yet
  EXPECT_FALSE(make_timeline(log, {}).has_value());
  EXPECT_TRUE(make_timeline(log, {.longest_gap = seconds(60)}).has_value());
  EXPECT_TRUE(make_timeline(log, {.speed = 1'000.0}).has_value());
}

TEST(Timeline, TheLongestLogAtTheHighestSpeedFits) {
  CanLog log = log_of({{0, 0}, {1, 0}});
  log.frames[0].at = {};
  log.frames[1].at = {9'000'000'000 * kNanosecondsPerSecond};
  const auto t = make_timeline(log, {.speed = 1e6});
  ASSERT_TRUE(t.has_value());
  EXPECT_EQ(t->buses[0].due[1], seconds(9'000));
  EXPECT_EQ(t->pass, seconds(18'000));
}

TEST(Timeline, OneFrameIsATimeline) {
  const auto t = make_timeline(log_of({{7, 0}}), {});
  ASSERT_TRUE(t.has_value());
  EXPECT_EQ(t->pass.ns, 0);
  EXPECT_EQ(t->buses[0].due[0].ns, 0);
}

}  // namespace
}  // namespace pitwall::replay
