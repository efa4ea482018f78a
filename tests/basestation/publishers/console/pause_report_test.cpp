// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/console/pause_report.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/basestation/publishers/console/json_of.hpp"

namespace pitwall::publishers::console {
namespace {

using transport::BenchPause;

constexpr Instant kStart{seconds(100).ns};

// The loop at its wake-ups: what was told at each, if anything.
struct PauseListener {
  PauseReport report;
  std::vector<json::JsonValue> reported;

  bool hears(Duration now, Duration total, Instant at = kStart) {
    const auto text = report.news(BenchPause{.now = now, .total = total}, at);
    if (text) reported.push_back(json_of(*text));
    return text.has_value();
  }
  double stands_ms() const { return reported.back().number("stands_ms"); }
  double stood_ms() const { return reported.back().number("stood_ms"); }
};

TEST(PauseReport, OfTheWallClockThereIsNothingToTell) {
  PauseReport report;
  EXPECT_FALSE(report.news(std::nullopt, kStart));
}

TEST(PauseReport, TellsAtOnceThatTheTimeIsABenchs) {
  PauseListener console;
  ASSERT_TRUE(console.hears({}, milliseconds(7)));
  EXPECT_EQ(console.reported.back().text("type"), "bench_time");
  EXPECT_EQ(console.reported.back().number("time_ms"), 100'000.0);
  EXPECT_EQ(console.stands_ms(), 0.0);
  EXPECT_EQ(console.stood_ms(), 7.0);
}

TEST(PauseReport, TellsALongPauseAgainAndAgainAlthoughItsOwnTimeStands) {
  PauseListener console;
  console.hears({}, {});
  for (int wake_ms = 10; wake_ms < 150; wake_ms += 10)
    EXPECT_FALSE(console.hears(milliseconds(wake_ms), milliseconds(wake_ms))) << wake_ms;
  ASSERT_TRUE(console.hears(milliseconds(150), milliseconds(150)));
  EXPECT_EQ(console.stands_ms(), 150.0);
  EXPECT_FALSE(console.hears(milliseconds(200), milliseconds(200)));
  ASSERT_TRUE(console.hears(milliseconds(250), milliseconds(250)));
  EXPECT_EQ(console.stands_ms(), 250.0);
  EXPECT_EQ(console.stood_ms(), 250.0);
}

TEST(PauseReport, TellsItsEndAtOnceAndTheNextOneAnew) {
  PauseListener console;
  console.hears(milliseconds(900), milliseconds(900));
  ASSERT_TRUE(console.hears(milliseconds(3), milliseconds(903)));
  EXPECT_EQ(console.stands_ms(), 0.0);
  EXPECT_EQ(console.stood_ms(), 903.0);
  EXPECT_TRUE(console.hears(milliseconds(160), milliseconds(1'060)));
  // Over and again within one wake-up.
  EXPECT_TRUE(console.hears(milliseconds(155), milliseconds(1'200)));
}

TEST(PauseReport, TellsWhatShortPausesAddUpToOnceASecond) {
  PauseListener console;
  console.hears({}, {});
  EXPECT_FALSE(console.hears({}, milliseconds(50), kStart + milliseconds(900)));
  ASSERT_TRUE(console.hears({}, milliseconds(50), kStart + seconds(1)));
  EXPECT_EQ(console.stood_ms(), 50.0);
  EXPECT_FALSE(console.hears({}, milliseconds(59), kStart + seconds(3))) << "less than is shown";
}

}  // namespace
}  // namespace pitwall::publishers::console
