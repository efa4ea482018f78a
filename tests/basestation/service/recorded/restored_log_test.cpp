// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/recorded/restored_log.hpp"

#include <gtest/gtest.h>

#include "basestation/replay/read_back.hpp"
#include "basestation/service/messages/settings_text.hpp"
#include "protocol/transport/file.hpp"
#include "tests/basestation/radio_rig.hpp"
#include "tests/basestation/replay/race.hpp"

namespace pitwall::service {
namespace {

TEST(LogReader, ABaseThatStartsAgainKnowsFieldsAndTrends) {
  const auto folder = transport::TemporaryFolder::create("pitwall_wall");
  RadioRig rig;
  replay::testing::record_race(folder->path(), seconds(6));
  LogReader memory{*rig.base};
  const Instant now = replay::testing::kRaceStart + seconds(7);
  const auto back = replay::read_back(folder->path(), replay::testing::kRaceClock, now,
                                      replay::kHistorySpan, memory);
  EXPECT_GT(back.messages, 1'000U);
  const auto field = telemetry::fields_of(telemetry::Group::kEgo).first + 1;
  const auto past = rig.base->past(field, replay::testing::kRaceStart, now, 1'000);
  EXPECT_GT(past.size(), 20U);
}

TEST(LogReader, WhatPeopleEnteredHoldsAgain) {
  const auto folder = transport::TemporaryFolder::create("pitwall_wall");
  RadioRig rig;
  {
    replay::testing::Recording recording{folder->path()};
    command::OperatorEntries given;
    given.expected = {.round_speed_mps = 51.4, .fuel_loaded_l = 40.0};
    given.round_speed_by = given.fuel_by = "Ada";
    given.fuel_at = replay::testing::kRaceStart;
    recording.text(recorder::Topic::kExpected, replay::testing::kRaceStart,
                   expected_text(given, 40.0, replay::testing::kRaceStart));
  }
  LogReader memory{*rig.base};
  const Instant now = replay::testing::kRaceStart + seconds(7);
  replay::read_back(folder->path(), replay::testing::kRaceClock, now, replay::kHistorySpan, memory);
  const auto recalled = memory.entries().result(now);
  ASSERT_TRUE(recalled);
  std::vector<alarms::EvaluatorInput> reported;
  rig.base->observe_inputs([&](const auto& input, Instant at) {
    if (!std::holds_alternative<state::Expectations>(input)) return;
    reported.push_back(input);
    EXPECT_EQ(at, now);
  });
  rig.base->restore(recalled->entries, recalled->fuel_left_l, now);
  EXPECT_EQ(rig.base->evaluator().known().expected.round_speed_mps, 51.4);
  ASSERT_EQ(reported.size(), 1u) << "a recording has it, for whoever judges again";
  rig.base->advance(now + seconds(1));
  EXPECT_EQ(rig.base->evaluator().fuel().level_l, 40.0);
}

}  // namespace
}  // namespace pitwall::service
