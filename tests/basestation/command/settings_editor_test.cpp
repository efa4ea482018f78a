// SPDX-License-Identifier: Apache-2.0
#include "basestation/command/settings_editor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/basestation/command/people.hpp"

namespace pitwall::command {
namespace {

constexpr state::FieldId kBattery = state::field_id("electric.battery");

struct Rig {
  alarms::Evaluator evaluator;
  Audit audit;
  bool disk_takes_it = true;
  int writes = 0;
  double written_limit = kUnset, written_budget = kUnset;
  std::uint64_t written_revision = 0;
  SettingsEditor editor{evaluator,
                        audit,
                        7,
                        {.least = 64.0, .most = 256.0, .now = 256.0},
                        [this](const SettingsEditor::Wanted& wanted) -> Result<bool, Problem> {
                          if (!disk_takes_it) return Unexpected{Problem{"wall.yaml", "disk full"}};
                          ++writes;
                          written_limit = wanted.alarms.of(slip()).limit;
                          written_budget = wanted.up_kbit_s;
                          written_revision = wanted.revision;
                          return true;
                        }};

  static alarms::AlarmIndex slip() { return *alarms::find_alarm("wheel_slip"); }
  static SettingsEditor::Origin origin(bool holds = true, std::string reason = "new tyres") {
    return {.by = kAda, .holds_authority = holds, .reason = std::move(reason), .at = {}};
  }
  alarms::AlarmEdit slip_at(double limit) const {
    alarms::AlarmEdit edit{.key = "wheel_slip",
                           .setting = alarms::default_setting(slip()),
                           .author = {},
                           .reason = {}};
    edit.setting.limit = limit;
    return edit;
  }
  static alarms::LimitEdit limit_of(state::FieldId field, const alarms::Limit& limit = {}) {
    return {.field = field, .limit = limit, .author = {}, .reason = {}};
  }
  double slip_limit() const { return evaluator.alarms().settings().of(slip()).limit; }
};

TEST(SettingsEditor, AChangeIsWrittenAndThenInForce) {
  Rig rig;
  const std::string before = rig.evaluator.alarms().settings().version_text();
  ASSERT_TRUE(rig.editor.change(Rig::origin(), rig.slip_at(0.1)));
  EXPECT_EQ(rig.slip_limit(), 0.1);
  EXPECT_EQ(rig.written_limit, 0.1);
  EXPECT_EQ(rig.written_revision, 8u);
  EXPECT_EQ(rig.editor.revision(), 8u);
  EXPECT_NE(rig.evaluator.alarms().settings().version_text(), before);
  EXPECT_EQ(rig.audit.lines().back(),
            (AuditLine{.number = 1,
                       .at = {},
                       .who = "Ada",
                       .what = "alarm wheel_slip limit 0.08 -> 0.1 (new tyres)",
                       .result = "revision 8"}));
}

// Whatever is the reason: refused means that nothing has changed anywhere, and that it was noted.
TEST(SettingsEditor, WhatIsRefusedChangesNothing) {
  Rig rig;
  const auto refused = [&](const Result<bool, Problem>& done, const char* what) {
    ASSERT_FALSE(done) << what;
    EXPECT_NE(done.error().what.find(what), std::string::npos) << done.error().what;
    EXPECT_EQ(rig.slip_limit(), 0.08);
    EXPECT_EQ(rig.editor.revision(), 7u);
    EXPECT_EQ(rig.editor.budget().now, 256.0);
    EXPECT_EQ(rig.writes, 0);
    EXPECT_EQ(rig.audit.lines().back().result, "refused: " + done.error().what);
  };
  refused(rig.editor.change(Rig::origin(false), rig.slip_at(0.1)), "authority");
  refused(rig.editor.change(Rig::origin(true, ""), rig.slip_at(0.1)), "reason");
  refused(rig.editor.change(Rig::origin(), rig.slip_at(kUnset)), "number");
  auto softer = rig.slip_at(0.1);
  softer.setting.priority = alarms::Priority::kLow;
  refused(rig.editor.change(Rig::origin(), softer), "a high alarm stays high");
  auto unknown = rig.slip_at(0.1);
  unknown.key = "nonsense";
  refused(rig.editor.change(Rig::origin(), unknown), "no such alarm");
  refused(rig.editor.change(Rig::origin(), Rig::limit_of(16'000)), "");
  const alarms::Limit crossed{.warning_low = 10.0, .bad_low = 12.0};
  refused(rig.editor.change(Rig::origin(), Rig::limit_of(kBattery, crossed)), "");
  refused(rig.editor.change_budget(Rig::origin(false), 128.0), "authority");
  for (const double wrong : {63.9, 256.1, -1.0, kUnset, double{INFINITY}}) {
    refused(rig.editor.change_budget(Rig::origin(), wrong), "expected 64 to 256 kbit/s");
  }
  rig.disk_takes_it = false;
  refused(rig.editor.change(Rig::origin(), rig.slip_at(0.1)), "disk full");
  refused(rig.editor.change_budget(Rig::origin(), 128.0), "disk full");
}

TEST(SettingsEditor, SetsOfValuesAreChangedAndNoted) {
  Rig rig;
  constexpr state::FieldId kMode = state::field_id("mode.mode");
  alarms::Limit limit = rig.evaluator.limits().of(kMode);
  ASSERT_EQ(limit.bad_values, 1U << 3 | 1U << 4);
  limit.bad_values = 1U << 3;
  limit.warning_values = 0;
  ASSERT_TRUE(rig.editor.change(Rig::origin(), Rig::limit_of(kMode, limit)));
  EXPECT_EQ(rig.evaluator.limits().of(kMode).bad_values, limit.bad_values);
  EXPECT_EQ(rig.evaluator.limits().of(kMode).warning_values, 0U);
  EXPECT_EQ(rig.audit.lines().back().what,
            "limits of mode.mode warning_values 6 -> none bad_values 3 4 -> 3 (new tyres)");
}

TEST(SettingsEditor, ABoundThatIsNotSaidIsNone) {
  Rig rig;
  ASSERT_TRUE(rig.editor.change(Rig::origin(), Rig::limit_of(kBattery, {.bad_low = 11.0})));
  EXPECT_EQ(rig.evaluator.limits().of(kBattery).bad_low, 11.0);
  EXPECT_TRUE(std::isnan(rig.evaluator.limits().of(kBattery).warning_low));
}

TEST(SettingsEditor, TheBudgetIsKeptWithTheRest) {
  Rig rig;
  ASSERT_TRUE(rig.editor.change_budget(Rig::origin(), 128.0));
  EXPECT_EQ(rig.editor.budget().now, 128.0);
  EXPECT_EQ(rig.written_budget, 128.0);
  ASSERT_TRUE(rig.editor.change(Rig::origin(), rig.slip_at(0.1)));
  EXPECT_EQ(rig.written_budget, 128.0);
}

TEST(SettingsEditor, WithoutAFileAChangeHoldsUntilTheEnd) {
  alarms::Evaluator evaluator;
  Audit audit;
  SettingsEditor editor{evaluator, audit, 0, {.most = 256.0, .now = 256.0}, {}};
  EXPECT_FALSE(editor.kept());
  ASSERT_TRUE(editor.change_budget(Rig::origin(), 100.0));
  EXPECT_EQ(editor.revision(), 1u);
}

}  // namespace
}  // namespace pitwall::command
