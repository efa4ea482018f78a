// SPDX-License-Identifier: Apache-2.0
#include "basestation/settings/judgement_file.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::settings {
namespace {

constexpr std::string_view kFile = R"(version: 1
fuel: {attempt_laps: 3, reserve_l: 1.5}
tyre_gate:
  speed_mps: [30, 40, 50, 60, 65]
  temperature_c: [20, 35, 50, 65, 79]
alarms:
  - {alarm: wheel_slip, limit: 0.1, deadband: 0.03, on_s: 0.2, author: Ada, reason: new tyres}
  - {alarm: computer_busy, priority: medium, author: "Bob \"B\" \\ Ltd: #1"}
limits:
  - {field: electric.battery, bad_low: 11.5, author: Ada, reason: old one}
  - {field: mode.mode, warning_values: [3, 6], bad_values: [4], author: Ada}
)";

TEST(JudgementFile, WhatPeopleChangedHolds) {
  const auto config = read_judgement_text(kFile, "wall.yaml");
  ASSERT_TRUE(config) << to_string(config.error());
  const auto slip = config->alarms.of(*alarms::find_alarm("wheel_slip"));
  EXPECT_EQ(slip.limit, 0.1);
  EXPECT_EQ(slip.on_delay, milliseconds(200));
  EXPECT_EQ(slip.off_delay, alarms::alarm_row(*alarms::find_alarm("wheel_slip")).off_delay);
  EXPECT_EQ(config->alarms.of(*alarms::find_alarm("computer_busy")).priority,
            alarms::Priority::kMedium);
  EXPECT_EQ(config->limits.of(state::field_id("electric.battery")).bad_low, 11.5);
  EXPECT_EQ(config->limits.of(state::field_id("mode.mode")).warning_values, 0x48U);
  EXPECT_EQ(config->derive.fuel.attempt_laps, 3.0);
  EXPECT_EQ(config->derive.fuel.home_laps, rules::FuelPlan{}.home_laps);
  EXPECT_EQ(config->derive.tyres.speed_mps[4], 65.0);
  EXPECT_NE(config->alarms.version(), alarms::AlarmSettings{}.version());
}

// Written and read again it is the same, and so is the second writing.
TEST(JudgementFile, WritingIsTheInverseOfReading) {
  const auto first = read_judgement_text(kFile, "wall.yaml");
  ASSERT_TRUE(first);
  const std::string text = judgement_text(first->derive, first->limits, first->alarms);
  const auto again = read_judgement_text(text, "written.yaml");
  ASSERT_TRUE(again) << to_string(again.error()) << "\n" << text;
  EXPECT_EQ(judgement_text(again->derive, again->limits, again->alarms), text);
  EXPECT_EQ(again->alarms.version(), first->alarms.version());
  EXPECT_EQ(again->alarms.edits().back().author, "Bob \"B\" \\ Ltd: #1");
  for (state::FieldId id = 0; id < telemetry::kFieldCount; ++id) {
    EXPECT_EQ(alarms::evaluate(again->limits.of(id), 11.6),
              alarms::evaluate(first->limits.of(id), 11.6));
  }
}

TEST(JudgementFile, RevisionAndBudgetAreKept) {
  const auto first = read_judgement_text("version: 1\n", "wall.yaml");
  ASSERT_TRUE(first);
  EXPECT_EQ(first->revision, 0u);
  EXPECT_TRUE(std::isnan(first->up_kbit_s));
  const auto again = read_judgement_text(
      judgement_text(first->derive, first->limits, first->alarms, 12, 128.5), "written.yaml");
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_EQ(again->revision, 12u);
  EXPECT_EQ(again->up_kbit_s, 128.5);
}

TEST(JudgementFile, AnEmptyOneIsTheDefaults) {
  const auto config = read_judgement_text("version: 1\n", "wall.yaml");
  ASSERT_TRUE(config);
  EXPECT_EQ(config->alarms.version(), alarms::AlarmSettings{}.version());
  const auto again = read_judgement_text(
      judgement_text(config->derive, config->limits, config->alarms), "written.yaml");
  ASSERT_TRUE(again) << to_string(again.error());
}

TEST(JudgementFile, AMistakeHasItsPlaceAndAReason) {
  struct Case {
    std::string_view text, place, what;
  };
  for (const Case& one : {
           Case{"alarms: []\n", "wall.yaml:1", "version"},
           Case{"version: 2\n", "wall.yaml:1:10", ""},
           Case{"version: 1\nalarm: []\n", "wall.yaml:2", "alarm"},
           Case{"version: 1\nalarms:\n  - {alarm: nonsense, author: Ada}\n", "wall.yaml:3",
                "no alarm is called nonsense"},
           Case{"version: 1\nalarms:\n  - {alarm: wheel_slip}\n", "wall.yaml:3", "author"},
           Case{"version: 1\nalarms:\n  - {alarm: wheel_slip, author: \"\"}\n", "wall.yaml:3", ""},
           Case{"version: 1\nalarms:\n  - {alarm: wheel_slip, author: A, priority: low}\n",
                "wall.yaml:3", "a high alarm stays high"},
           Case{"version: 1\nalarms:\n  - {alarm: wheel_slip, author: A, limit: .nan}\n",
                "wall.yaml:3", ""},
           Case{"version: 1\nlimits:\n  - {field: ego.z, author: A}\n", "wall.yaml:3",
                "no field is called ego.z"},
           Case{"version: 1\nlimits:\n  - {field: ego.vx, warning_low: 5, bad_low: 9, author: A}\n",
                "wall.yaml:3", "bad_low"},
           Case{"version: 1\ntyre_gate: {speed_mps: [1, 2, 3, 4, 4], temperature_c: [1, 2, 3, 4, "
                "5]}",
                "wall.yaml:2", "must rise"},
           Case{"version: 1\nfuel: {attempt_laps: 0}\n", "wall.yaml:2", ""},
           Case{"version: [\n", "wall.yaml:", ""},
       }) {
    const auto config = read_judgement_text(one.text, "wall.yaml");
    ASSERT_FALSE(config) << one.text;
    EXPECT_EQ(config.error().place.find(one.place), 0U) << to_string(config.error());
    EXPECT_NE(config.error().what.find(one.what), std::string::npos) << to_string(config.error());
  }
  EXPECT_FALSE(read_judgement_file("/nonexistent/wall.yaml"));
}

}  // namespace
}  // namespace pitwall::settings
