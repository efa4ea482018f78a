// SPDX-License-Identifier: Apache-2.0
#include "hil/nodes/match_sheet.hpp"

#include <gtest/gtest.h>

#include "protocol/json/json_value.hpp"

namespace pitwall::race {
namespace {

MatchSheet after(const std::vector<rules::Ending>& endings) {
  const rules::PassingRules rules;
  JudgeState state;
  state.match = rules::begin_match(1);
  for (const rules::Ending ending : endings) {
    AttemptRecord record;
    record.assignment = *rules::due(rules, state.match);
    record.waving = Instant{} + seconds(40);
    record.ended = Instant{} + seconds(60);
    record.laps_used = 0.75;
    record.ending = ending;
    record.score = rules::score_of(rules, ending, state.match.repeats);
    EXPECT_TRUE(state.attempts.push(record));
    state.match = rules::record(rules, state.match, ending);
  }
  return sheet_of(state, {"own", "blue"});
}

TEST(MatchSheet, NamesTheResult) {
  using rules::Ending;
  EXPECT_EQ(result_text(after({})), "open");
  EXPECT_EQ(result_text(after({Ending::kPassed, Ending::kOutOfLaps})), "blue");
  EXPECT_EQ(result_text(after({Ending::kDeclined, Ending::kPassed})), "own");
  EXPECT_EQ(result_text(after({Ending::kDeclined, Ending::kEarly})), "draw");
}

TEST(MatchSheet, SaysInOneSentenceWhoTriedWhatAndWhyItEnded) {
  const MatchSheet sheet = after({rules::Ending::kPassed, rules::Ending::kOutOfLaps});
  EXPECT_EQ(
      to_text(sheet, 1),
      "attempt 2, 80 mph, own attacks, 0.75 laps: out_of_laps (failed): no gap of 30 m within "
      "two laps");
}

TEST(MatchSheet, IsReadBackFromItsJson) {
  const auto json = json::JsonValue::parse(
      to_json(after({rules::Ending::kPassed, rules::Ending::kStopped})), "sheet.json");
  ASSERT_TRUE(json) << to_string(json.error());
  EXPECT_EQ(json->text("result"), "open");
  ASSERT_EQ(json->items("cars").size(), 2U);
  EXPECT_EQ(json->items("cars")[1].text(), "blue");
  ASSERT_EQ(json->items("attempts").size(), 2U);
  const json::JsonValue& first = json->items("attempts")[0];
  EXPECT_EQ(first.text("attacker"), "blue");
  EXPECT_EQ(first.number("round"), 1.0);
  EXPECT_EQ(first.number("round_speed_mph"), 80.0);
  EXPECT_NEAR(first.number("waving_s"), 40.0, 1e-9);
  EXPECT_TRUE(std::isnan(first.number("clear_s"))) << "not reached";
  EXPECT_EQ(json->items("attempts")[1].text("score"), "repeated");
}

}  // namespace
}  // namespace pitwall::race
