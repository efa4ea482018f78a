// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/wall/memory.hpp"

#include <gtest/gtest.h>

#include "basestation/outlets/wall/settings_text.hpp"
#include "basestation/replay/read_back.hpp"
#include "protocol/transport/file.hpp"
#include "tests/basestation/outlets/wall/station_wall.hpp"
#include "tests/basestation/replay/race.hpp"

namespace pitwall::outlets::wall {
namespace {

TEST(Memory, AWallThatStartsAgainRemembersFieldsAndTrends) {
  const auto folder = transport::TemporaryFolder::create("pitwall_wall");
  StationWall base;
  replay::testing::record_race(folder->path(), seconds(6));
  Memory memory{base.wall};
  const Instant now = replay::testing::kRaceStart + seconds(7);
  const auto back = replay::read_back(folder->path(), replay::testing::kRaceClock, now,
                                      replay::kHistorySpan, memory);
  EXPECT_GT(back.messages, 1'000U);
  const auto field = telemetry::fields_of(telemetry::Group::kEgo).first + 1;
  const auto past = base.wall.trends().range(field, replay::testing::kRaceStart, now, 1'000);
  EXPECT_GT(past.size(), 20U);
}

TEST(Memory, WhatPeopleEnteredHoldsAgain) {
  const auto folder = transport::TemporaryFolder::create("pitwall_wall");
  StationWall base;
  {
    replay::testing::Recording recording{folder->path()};
    PeopleSaid said;
    said.expected = {.round_speed_mps = 51.4, .fuel_loaded_l = 40.0};
    said.round_speed_by = said.fuel_by = "Ada";
    said.fuel_at = replay::testing::kRaceStart;
    recording.text(recorder::Topic::kExpected, replay::testing::kRaceStart,
                   expected_text(said, 40.0, replay::testing::kRaceStart));
  }
  Memory memory{base.wall};
  const Instant now = replay::testing::kRaceStart + seconds(7);
  replay::read_back(folder->path(), replay::testing::kRaceClock, now, replay::kHistorySpan, memory);
  const auto recalled = memory.recall().result(now);
  ASSERT_TRUE(recalled);
  std::vector<picture::WatchInput> told;
  base.wall.watch().tell_inputs([&](const auto& input, Instant at) {
    told.push_back(input);
    EXPECT_EQ(at, now);
  });
  base.wall.recall(*recalled, now);
  EXPECT_EQ(base.wall.watch().known().expected.round_speed_mps, 51.4);
  EXPECT_EQ(told.size(), 1u) << "a recording has it, for whoever judges again";
  base.wall.watch().advance({}, now + seconds(1));
  EXPECT_EQ(base.wall.watch().fuel().level_l, 40.0);
}

}  // namespace
}  // namespace pitwall::outlets::wall
