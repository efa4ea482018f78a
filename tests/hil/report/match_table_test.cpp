// SPDX-License-Identifier: Apache-2.0
#include "hil/report/match_table.hpp"

#include <gtest/gtest.h>

#include "hil/nodes/match_sheet.hpp"
#include "hil/report/page.hpp"
#include "tests/hil/report/some_run.hpp"

namespace pitwall::report {
namespace {

// Our car passes at 80 mph; the other one is stopped by its door.
race::MatchSheet some_sheet() {
  const rules::PassingRules rules;
  race::MatchSheet sheet{
      .names = {"own", "blue & <co>"}, .attempts = {}, .match = rules::begin_match(0)};
  for (const rules::Ending ending : {rules::Ending::kPassed, rules::Ending::kCutIn}) {
    race::AttemptRecord record;
    record.assignment = *rules::due(rules, sheet.match);
    record.green = at_s(31.0);
    record.ended = at_s(99.5);
    record.most_lead_m = 41.25;
    record.ending = ending;
    record.score = rules::score_of(rules, ending, 0);
    sheet.attempts.push_back(record);
    sheet.match = rules::record(rules, sheet.match, ending);
  }
  return sheet;
}

MatchRows rows_of(const race::MatchSheet& sheet) {
  const auto json =
      json::JsonValue::parse("{\"match\": " + race::to_json(sheet) + "}", "result.json");
  if (!json) ADD_FAILURE() << to_string(json.error());
  return match_of(*json).value_or(MatchRows{});
}

TEST(MatchTable, HasTheSheetThatWasWritten) {
  const MatchRows rows = rows_of(some_sheet());
  EXPECT_EQ(rows.result, "own");
  ASSERT_EQ(rows.attempts.size(), 2u);
  EXPECT_EQ(rows.attempts[0].attacker, "own");
  EXPECT_EQ(rows.attempts[1].attacker, "blue & <co>");
  EXPECT_EQ(rows.attempts[1].defender, "own");
  EXPECT_EQ(rows.attempts[0].ending, "passed");
  EXPECT_EQ(rows.attempts[0].score, "passed");
  EXPECT_EQ(rows.attempts[1].ending, "cut_in");
  EXPECT_EQ(rows.attempts[1].score, "failed");
  EXPECT_EQ(rows.attempts[0].round_speed_mph, 80.0);
  EXPECT_NEAR(rows.attempts[0].green_s, 31.0, 1e-9);
  EXPECT_NEAR(rows.attempts[0].ended_s, 99.5, 1e-9);
  EXPECT_EQ(rows.attempts[0].most_lead_m, 41.25);
  EXPECT_TRUE(std::isnan(rows.attempts[0].waving_s)) << "not reached";
}

TEST(MatchTable, ShowsEachAttemptWithItsReasonAndEscapesNames) {
  const std::string html = match_table(rows_of(some_sheet()));
  EXPECT_EQ(count(html, "<tr>"), 3u);
  EXPECT_EQ(count(html, "Result: own"), 1u);
  EXPECT_EQ(count(html, "less than 30 m to the defender"), 1u);
  EXPECT_EQ(count(html, "blue &amp; &lt;co&gt;"), 2u);
  EXPECT_EQ(count(html, "<co>"), 0u);
  EXPECT_EQ(count(html, "<td>41.2</td>") + count(html, "<td>41.3</td>"), 2u);
  EXPECT_EQ(count(match_table({.attempts = {}, .result = "open"}), "No attempt has ended"), 1u);
}

TEST(MatchTable, IsOnThePageOfARunWithAMatchOnly) {
  RunData run = run_of({});
  add_result(run, result_of(run), "run.json");
  EXPECT_FALSE(run.result->match);
  EXPECT_EQ(count(page(run, nullptr, "no track"), "Match sheet"), 0u);
  run.result->match = rows_of(some_sheet());
  EXPECT_EQ(count(page(run, nullptr, "no track"), "<h2>Match sheet</h2>"), 1u);
}

}  // namespace
}  // namespace pitwall::report
