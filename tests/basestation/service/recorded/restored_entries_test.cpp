// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/recorded/restored_entries.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "basestation/service/messages/settings_text.hpp"

namespace pitwall::service {
namespace {

using telemetry::field;

constexpr Instant kEntered{seconds(500).ns};

command::OperatorEntries entries() {
  command::OperatorEntries given;
  given.expected = {.round_speed_mps = 51.4, .track_flag = 4.0, .fuel_loaded_l = 40.0};
  given.round_speed_by = "Ada";
  given.fuel_by = "Bob";
  given.fuel_at = kEntered;
  return given;
}

// The engine at full throttle, told ten times a second.
void drive(EntriesReader& restored, Instant from, Instant to) {
  telemetry::Snapshot state;
  state.values[field("engine.speed")] = 5'000.0;
  state.values[field("powertrain.throttle_position")] = 1.0;
  state.values[field("engine.running")] = 1.0;
  telemetry::GroupSet groups;
  groups.add(telemetry::Group::kPowertrain);
  for (Instant at = from; at <= to; at += milliseconds(100)) {
    state.at(telemetry::Group::kPowertrain) = at;
    restored.state(state, groups);
  }
}

constexpr rules::EngineSample kFull{.speed_rpm = 5'000.0, .throttle = 1.0, .running = true};

TEST(EntriesReader, NobodyEnteredAnything) {
  EntriesReader restored;
  drive(restored, kEntered, kEntered + seconds(10));
  restored.expected("not a text", kEntered);
  EXPECT_FALSE(restored.result(kEntered + seconds(10)));
}

TEST(EntriesReader, EntriesComeBackWithTheirNames) {
  EntriesReader restored;
  restored.expected(expected_text(entries(), 40.0, kEntered + seconds(5)), kEntered + seconds(5));
  const auto back = restored.result(kEntered + seconds(60));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->entries.expected.round_speed_mps, 51.4);
  EXPECT_EQ(back->entries.expected.track_flag, 4.0);
  EXPECT_EQ(back->entries.expected.fuel_loaded_l, 40.0);
  EXPECT_EQ(back->entries.expected.fuel_entries, 1u);
  EXPECT_EQ(back->entries.round_speed_by, "Ada");
  EXPECT_EQ(back->entries.fuel_by, "Bob");
  EXPECT_EQ(back->entries.fuel_at, kEntered);
  EXPECT_EQ(back->fuel_left_l, 40.0);
}

// The clock of the recording was another one: what counts is how long ago it was.
TEST(EntriesReader, TimesAreThoseOfTheClockOfNow) {
  EntriesReader restored;
  restored.expected(expected_text(entries(), 40.0, kEntered + seconds(5)), Instant{-seconds(1).ns});
  EXPECT_EQ(restored.result({})->entries.fuel_at, Instant{-seconds(6).ns});
}

TEST(EntriesReader, FuelIsReckonedOnThroughTheRecording) {
  EntriesReader restored;
  drive(restored, kEntered - seconds(100), kEntered);  // before it was filled in
  restored.expected(expected_text(entries(), 40.0, kEntered), kEntered);
  drive(restored, kEntered + milliseconds(100), kEntered + seconds(100));
  const double flow_lps = rules::fuel_flow_lps(kFull);
  EXPECT_GT(flow_lps, 0.01);
  EXPECT_NEAR(restored.result(kEntered + seconds(100))->fuel_left_l, 40.0 - 100.0 * flow_lps, 1e-6);
  // WHEN the newest text says how much was left
  restored.expected(expected_text(entries(), 30.0, kEntered + seconds(100)),
                    kEntered + seconds(100));
  drive(restored, kEntered + milliseconds(100'100), kEntered + seconds(110));
  EXPECT_NEAR(restored.result(kEntered + seconds(110))->fuel_left_l, 30.0 - 10.0 * flow_lps, 1e-6);
}

TEST(EntriesReader, WhatNobodyHeardWasBurntButNeverMoreThanThereWas) {
  EntriesReader restored;
  restored.expected(expected_text(entries(), 40.0, kEntered), kEntered);
  drive(restored, kEntered, kEntered + seconds(1));
  const double flow_lps = rules::fuel_flow_lps(kFull);
  EXPECT_NEAR(restored.result(kEntered + seconds(61))->fuel_left_l, 40.0 - 61.0 * flow_lps, 1e-6);
  EXPECT_EQ(restored.result(kEntered + seconds(100'000))->fuel_left_l, 0.0);
}

TEST(EntriesReader, WhereNoFuelWasEnteredNoneIsLeft) {
  command::OperatorEntries given = entries();
  given.expected.fuel_loaded_l = kUnset;
  EntriesReader restored;
  restored.expected(expected_text(given, kUnset, kEntered), kEntered);
  drive(restored, kEntered, kEntered + seconds(1));
  const auto back = restored.result(kEntered + seconds(2));
  EXPECT_TRUE(std::isnan(back->fuel_left_l));
  EXPECT_EQ(back->entries.expected.fuel_entries, 0u);
}

}  // namespace
}  // namespace pitwall::service
