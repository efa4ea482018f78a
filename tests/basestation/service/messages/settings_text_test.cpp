// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/messages/settings_text.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/basestation/publishers/console/json_of.hpp"

namespace pitwall::service {
namespace {

using publishers::console::json_of;

TEST(SettingsText, EveryAlarmHasWhatAnEditorNeeds) {
  alarms::Evaluator evaluator;
  command::Audit audit;
  command::SettingsEditor editor{evaluator, audit, 3, {.most = 256.0, .now = 128.0}, {}};
  ASSERT_TRUE(evaluator.edit(
      {.key = "coolant_hot",
       .setting = {.priority = alarms::Priority::kHigh, .limit = 105.0, .deadband = 2.0},
       .author = "Ada",
       .reason = "hot day"}));
  const auto reported = json_of(settings_text(editor, evaluator.alarms().settings()));
  EXPECT_EQ(reported.number("revision"), 3.0);
  EXPECT_FALSE(reported.flag("kept"));
  EXPECT_EQ(reported.number("up_kbit_s"), 128.0);
  EXPECT_EQ(reported.number("up_most_kbit_s"), 256.0);
  ASSERT_EQ(reported.items("alarms").size(), alarms::alarm_count());
  for (const auto& alarm : reported.items("alarms")) {
    const auto index = alarms::find_alarm(alarm.text("key"));
    ASSERT_TRUE(index);
    const alarms::AlarmSetting& set = evaluator.alarms().settings().of(*index);
    EXPECT_EQ(alarm.number("limit"), set.limit);
    EXPECT_EQ(alarm.number("on_s"), set.on_delay.seconds());
    EXPECT_EQ(alarm.text("priority"), alarms::text_of(set.priority));
    EXPECT_TRUE(state::find_field(alarm.text("path")));
    EXPECT_EQ(alarm.text("by"), alarm.text("key") == "coolant_hot" ? "Ada" : "");
  }
}

TEST(SettingsText, WhatNobodySaidIsNull) {
  const auto nothing = json_of(expected_text({}, kUnset, {}));
  EXPECT_TRUE(std::isnan(nothing.number("round_speed_mps")));
  EXPECT_TRUE(std::isnan(nothing.number("fuel_ms")));
  command::OperatorEntries entries;
  entries.expected.round_speed_mps = 51.4;
  entries.expected.fuel_loaded_l = 40.0;
  entries.fuel_by = "Ada";
  entries.fuel_at = Instant{seconds(2).ns};
  const auto reported = json_of(expected_text(entries, 38.5, Instant{seconds(3).ns}));
  EXPECT_EQ(reported.number("round_speed_mps"), 51.4);
  EXPECT_EQ(reported.number("fuel_ms"), 2'000.0);
  EXPECT_EQ(reported.text("fuel_by"), "Ada");
  EXPECT_EQ(reported.number("fuel_left_l"), 38.5);
  EXPECT_EQ(reported.number("time_ms"), 3'000.0);
}

}  // namespace
}  // namespace pitwall::service
