// SPDX-License-Identifier: Apache-2.0
#include "basestation/replay/read_back.hpp"

#include <gtest/gtest.h>

#include "protocol/transport/file.hpp"
#include "tests/basestation/replay/race.hpp"

namespace pitwall::replay {
namespace {

using testing::Console;
using testing::kRaceClock;
using testing::kRaceStart;
using testing::Race;

TEST(ReadBack, ABaseThatStartsAgainKnowsTheRaceAndItsHistory) {
  const auto folder = transport::TemporaryFolder::create("pitwall_back");
  testing::record_race(folder->path(), seconds(45));
  const Instant now = kRaceStart + seconds(47);
  Console console, live;
  Race{}.go_to(kRaceStart + seconds(45), live);
  // The calendar was set in between: of one boot that changes nothing.
  recorder::ClockMap clock = kRaceClock;
  clock.utc_minus_base = clock.utc_minus_base + seconds(9);
  const ReadBack back = read_back(folder->path(), clock, now, kHistorySpan, console);
  testing::expect_same(console.vehicle, live.vehicle, now);
  EXPECT_EQ(console.texts, live.texts);
  EXPECT_EQ(back.segments, 3U);
  EXPECT_EQ(back.first, kRaceStart);
  EXPECT_EQ(back.last, kRaceStart + seconds(45));
}

TEST(ReadBack, OnlyTheSpanIsTold) {
  const auto folder = transport::TemporaryFolder::create("pitwall_back");
  testing::record_race(folder->path(), seconds(45));
  const Instant now = kRaceStart + seconds(46);
  Console console, live;
  Race{}.go_to(kRaceStart + seconds(45), live);
  const ReadBack back = read_back(folder->path(), kRaceClock, now, seconds(10), console);
  EXPECT_EQ(back.segments, 2U);  // from 36 s on, and from 40 s on
  testing::expect_same(console.vehicle, live.vehicle, now);
  EXPECT_GE(back.first, now - seconds(10));
}

TEST(ReadBack, AfterANewStartOfTheMachineTimesGoByTheCalendar) {
  const auto folder = transport::TemporaryFolder::create("pitwall_back");
  testing::record_race(folder->path(), seconds(5));
  // The new clock began two minutes after the end of the race, and stands at 30 s.
  const Instant end_utc = kRaceClock.to_file(kRaceStart + seconds(5));
  recorder::ClockMap clock{.utc_minus_base = Duration{end_utc.ns} + seconds(120), .boot = "new"};
  Console console;
  const ReadBack back =
      read_back(folder->path(), clock, Instant{seconds(30).ns}, kHistorySpan, console);
  EXPECT_EQ(back.last, Instant{-seconds(120).ns});
  EXPECT_EQ(console.vehicle.view(0, Instant{seconds(30).ns}).quality, state::Quality::kStale);
}

TEST(ReadBack, WhereNothingIsNothingIsTold) {
  Console console;
  EXPECT_EQ(read_back("/nowhere", kRaceClock, Instant{}, kHistorySpan, console).messages, 0U);
}

}  // namespace
}  // namespace pitwall::replay
