// SPDX-License-Identifier: Apache-2.0
#include "basestation/alarms/limits.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace pitwall::alarms {
namespace {

constexpr state::FieldId kBattery = state::field_id("electric.battery");

state::FieldView fresh(double value) {
  return {.value = value, .age = {}, .quality = state::Quality::kFresh};
}

TEST(Limits, AValueAtALimitIsStillOnItsGoodSide) {
  const Limit limit{.warning_low = 10, .warning_high = 20, .bad_low = 5, .bad_high = 30};
  EXPECT_EQ(evaluate(limit, 10), Evaluation::kGood);
  EXPECT_EQ(evaluate(limit, 20), Evaluation::kGood);
  EXPECT_EQ(evaluate(limit, 9.9), Evaluation::kWarning);
  EXPECT_EQ(evaluate(limit, 5), Evaluation::kWarning);
  EXPECT_EQ(evaluate(limit, 30), Evaluation::kWarning);
  EXPECT_EQ(evaluate(limit, 4.9), Evaluation::kBad);
  EXPECT_EQ(evaluate(limit, 30.1), Evaluation::kBad);
  EXPECT_EQ(evaluate(limit, kUnset), Evaluation::kNone);
  EXPECT_EQ(evaluate({}, 1.0), Evaluation::kNone);
}

// The further out, the worse: no bound makes a value better again.
TEST(Limits, JudgementNeverImprovesOutwards) {
  const Limits limits;
  for (state::FieldId id = 0; id < telemetry::kFieldCount; ++id) {
    const Limit& limit = limits.of(id);
    if (!limit.bounded()) continue;
    const telemetry::FieldRow& row = telemetry::kFields[id];
    const double middle = std::isnan(limit.warning_low) ? row.min : row.max;
    if (!std::isnan(limit.warning_low) && !std::isnan(limit.warning_high)) continue;
    Evaluation worst = evaluate(limit, middle);
    for (int i = 0; i <= 200; ++i) {
      const double to =
          std::isnan(limit.warning_low) && std::isnan(limit.bad_low) ? row.max : row.min;
      const Evaluation now = evaluate(limit, middle + (to - middle) * i / 200.0);
      EXPECT_GE(now, worst) << state::path_of(id);
      worst = now;
    }
  }
}

TEST(Limits, AStaleOrUnheardValueHasNoJudgement) {
  const Limits limits;
  state::FieldView view = fresh(11.0);
  EXPECT_EQ(limits.evaluate(kBattery, view), Evaluation::kBad);
  view.quality = state::Quality::kLate;
  EXPECT_EQ(limits.evaluate(kBattery, view), Evaluation::kBad);
  for (const state::Quality quality : {state::Quality::kStale, state::Quality::kNever}) {
    view.quality = quality;
    EXPECT_EQ(limits.evaluate(kBattery, view), Evaluation::kNone);
  }
}

TEST(Limits, SetsOfValuesJudgeEnumerations) {
  const Limits limits;
  constexpr state::FieldId kMode = state::field_id("mode.mode");
  EXPECT_EQ(limits.evaluate(kMode, fresh(2)), Evaluation::kGood);  // driving
  EXPECT_EQ(limits.evaluate(kMode, fresh(4)), Evaluation::kBad);   // emergency stop
  EXPECT_EQ(limits.evaluate(kMode, fresh(6)), Evaluation::kWarning);
  EXPECT_EQ(limits.evaluate(kMode, fresh(-3)), Evaluation::kGood);  // no such value, no such bit
}

TEST(Limits, AnEditHoldsAndNamesItsAuthor) {
  Limits limits;
  const Limit wanted{.bad_low = 11.0};
  ASSERT_TRUE(limits.edit({kBattery, wanted, "Ada", "old battery"}));
  EXPECT_EQ(limits.evaluate(kBattery, fresh(11.5)), Evaluation::kGood);
  ASSERT_EQ(limits.edits().size(), 1U);
  EXPECT_EQ(limits.edits().front().author, "Ada");
}

TEST(Limits, ABadEditIsRefusedAndChangesNothing) {
  Limits limits;
  const Limit before = limits.of(kBattery);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const LimitEdit& bad :
       {LimitEdit{kBattery, {.bad_low = 11.0}, "", ""}, LimitEdit{9'999, {}, "Ada", ""},
        LimitEdit{kBattery, {.warning_low = 10, .bad_low = 11}, "Ada", ""},
        LimitEdit{kBattery, {.warning_low = 14, .warning_high = 12}, "Ada", ""},
        LimitEdit{kBattery, {.warning_high = infinity}, "Ada", ""}}) {
    const auto edited = limits.edit(bad);
    ASSERT_FALSE(edited);
    EXPECT_FALSE(edited.error().what.empty());
  }
  EXPECT_DOUBLE_EQ(limits.of(kBattery).bad_low, before.bad_low);
  EXPECT_TRUE(limits.edits().empty());
}

}  // namespace
}  // namespace pitwall::alarms
