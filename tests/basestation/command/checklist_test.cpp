// SPDX-License-Identifier: Apache-2.0
#include "basestation/command/checklist.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "tests/basestation/healthy_race.hpp"

namespace pitwall::command {
namespace {

using telemetry::field;

// A healthy car in its pit, everything told, and somebody at the console.
struct ChecklistPit {
  HealthyRace wall;
  state::BaseFigures base{.disk_minutes = 400.0, .recording = 1.0, .clock_offset_ms = 0.4};
  telemetry::HolderId holder = 16;
  SettingsState settings{.version = "3-3f2a", .kept = true};
  JoystickState joystick = JoystickState::kReleased;

  ChecklistPit() {
    wall.set(field("uplink.schema_agrees"), 1.0);
    for (const auto wheel :
         {field("tyres.pressure_front_left"), field("tyres.pressure_front_right"),
          field("tyres.pressure_rear_left"), field("tyres.pressure_rear_right")}) {
      wall.set(wheel, 150.0);
    }
  }
  std::vector<Check> checks() {
    wall.evaluator.base(base);
    wall.run(seconds(5));
    return now();
  }
  std::vector<Check> now() const {
    return checks_of({.vehicle = wall.reported.vehicle,
                      .evaluator = wall.evaluator,
                      .holder = holder,
                      .holder_name = "console 16",
                      .settings = settings,
                      .joystick = joystick,
                      .now = wall.now});
  }
};

using CheckKinds = std::vector<CheckKind>;

CheckKinds no_go(const std::vector<Check>& checks) {
  CheckKinds kinds;
  for (const Check& check : checks) {
    if (!check.go) kinds.push_back(check.kind);
  }
  return kinds;
}

std::string text(const std::vector<Check>& checks, CheckKind kind) {
  return checks.at(static_cast<std::size_t>(kind)).text;
}

TEST(Checklist, AHealthyCarMayGo) {
  ChecklistPit pit;
  const auto checks = pit.checks();
  EXPECT_EQ(no_go(checks), CheckKinds{});
  EXPECT_TRUE(all_go(checks));
  ASSERT_EQ(checks.size(), kChecks);
  for (std::size_t i = 0; i < kChecks; ++i) {
    EXPECT_EQ(checks[i].kind, static_cast<CheckKind>(i));
    EXPECT_TRUE(checks[i].known);
    EXPECT_FALSE(checks[i].text.empty());
    EXPECT_FALSE(text_of(checks[i].kind).empty());
  }
  EXPECT_EQ(text(checks, CheckKind::kTyres), "softest 150.0 kPa, coldest 85.0 \u00b0C");
  EXPECT_EQ(text(checks, CheckKind::kAuthority), "held by console 16");
}

TEST(Checklist, NothingIsAGoThatWasNeverHeard) {
  const HealthyRace silent;
  state::VehicleState nothing;
  const alarms::Evaluator evaluator;
  const auto checks = checks_of({.vehicle = nothing, .evaluator = evaluator, .now = silent.now});
  EXPECT_FALSE(all_go(checks));
  EXPECT_FALSE(all_go({}));
  for (const Check& check : checks) {
    // Only what the base knows by itself can be a go: no joystick, no high alarm.
    const bool own = check.kind == CheckKind::kJoystick || check.kind == CheckKind::kAlarms;
    EXPECT_EQ(check.go, own) << text_of(check.kind) << ": " << check.text;
  }
}

TEST(Checklist, WhatTheCarSaidLongAgoIsNoGo) {
  ChecklistPit pit;
  ASSERT_TRUE(all_go(pit.checks()));
  pit.wall.packets = false;
  pit.wall.run(seconds(8));
  const auto later = pit.now();
  for (const CheckKind kind : {CheckKind::kLink, CheckKind::kSoftware, CheckKind::kCorrections,
                               CheckKind::kTyres, CheckKind::kFuel, CheckKind::kStop}) {
    const Check& check = later.at(static_cast<std::size_t>(kind));
    EXPECT_FALSE(check.go) << text_of(kind) << ": " << check.text;
    if (kind == CheckKind::kLink) continue;  // that it is lost is known
    EXPECT_FALSE(check.known) << text_of(kind) << ": " << check.text;
    EXPECT_GT(check.age, seconds(2)) << text_of(kind);
  }
}

TEST(Checklist, EachItemAloneHoldsTheCarBack) {
  const std::vector<std::pair<CheckKind, std::function<void(ChecklistPit&)>>> wrongs{
      {CheckKind::kSoftware, [](ChecklistPit& pit) { pit.base.schema_differs = true; }},
      {CheckKind::kSoftware,
       [](ChecklistPit& pit) { pit.wall.set(field("uplink.schema_agrees"), 0.0); }},
      {CheckKind::kClocks, [](ChecklistPit& pit) { pit.base.clock_offset_ms = 7.0; }},
      {CheckKind::kClocks, [](ChecklistPit& pit) { pit.base.clock_offset_ms = kUnset; }},
      {CheckKind::kDisk, [](ChecklistPit& pit) { pit.base.recording = 0.0; }},
      {CheckKind::kDisk, [](ChecklistPit& pit) { pit.base.recording = 2.0; }},
      {CheckKind::kDisk, [](ChecklistPit& pit) { pit.base.disk_minutes = 30.0; }},
      {CheckKind::kSettings, [](ChecklistPit& pit) { pit.settings.kept = false; }},
      {CheckKind::kSettings, [](ChecklistPit& pit) { pit.settings.readable = false; }},
      {CheckKind::kAuthority, [](ChecklistPit& pit) { pit.holder = 0; }},
      {CheckKind::kJoystick, [](ChecklistPit& pit) { pit.joystick = JoystickState::kInUse; }},
      {CheckKind::kJoystick, [](ChecklistPit& pit) { pit.joystick = JoystickState::kLost; }},
      {CheckKind::kTyres,
       [](ChecklistPit& pit) { pit.wall.set(field("tyres.pressure_rear_left"), 90.0); }},
      {CheckKind::kFuel, [](ChecklistPit& pit) { pit.wall.set(field("fuel.level"), 5.0); }},
      {CheckKind::kStop, [](ChecklistPit& pit) { pit.wall.set(field("mode.stop_latch"), 1.0); }},
  };
  for (const auto& [kind, wrong] : wrongs) {
    ChecklistPit pit;
    wrong(pit);
    const auto checks = pit.checks();
    const Check& check = checks.at(static_cast<std::size_t>(kind));
    EXPECT_FALSE(check.go) << text_of(kind) << ": " << check.text;
    for (const CheckKind other : no_go(checks)) {
      // A high alarm may say the same.
      EXPECT_TRUE(other == kind || other == CheckKind::kAlarms) << text_of(other);
    }
  }
}

TEST(Checklist, NoJoystickIsNoReasonToStay) {
  ChecklistPit pit;
  pit.joystick = JoystickState::kNone;
  EXPECT_TRUE(all_go(pit.checks()));
}

// Two users of one RTK login: both receivers lose the corrections again and again.
TEST(Checklist, ASecondUserOfTheLoginIsSeen) {
  ChecklistPit pit;
  ASSERT_TRUE(all_go(pit.checks()));
  for (int i = 0; i < 4; ++i) {
    for (const double age_s : {1.0, 8.0, 1.0}) {
      pit.wall.set(field("gnss0.differential_age"), age_s);
      pit.wall.set(field("gnss1.differential_age"), age_s);
      pit.wall.run(seconds(4));
    }
  }
  const auto checks = pit.now();
  EXPECT_FALSE(checks.at(static_cast<std::size_t>(CheckKind::kCorrections)).go);
  EXPECT_EQ(text(checks, CheckKind::kCorrections),
            "somebody else uses the login, corrections 1.0 s old");
}

}  // namespace
}  // namespace pitwall::command
