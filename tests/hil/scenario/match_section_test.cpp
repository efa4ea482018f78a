// SPDX-License-Identifier: Apache-2.0
#include "hil/scenario/match_section.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "hil/scenario/scenario.hpp"

namespace pitwall::scenario {
namespace {

const std::string kGhost =
    "cars: [{name: blue, number: 2, kind: ghost, start: {s_m: 60}, speed: {mps: 44}}]\n";
const std::string kStack =
    "cars: [{name: blue, number: 2, kind: stack, car: c.yaml, start: {s_m: 60}}]\n";
const std::string kLanes = "lanes: {inside_m: 0, outside_m: -5}";

Result<Scenario, Problem> with_match(const std::string& match, const std::string& cars = kGhost) {
  return read_scenario(
      "schema: 1\nname: short\nseed: 3\nduration_s: 20\ntrack: t.yaml\ncar: c.yaml\n"
      "race_control: [{at_s: 0.5, track: red}]\n" +
          cars + "match: {" + match + "}\n",
      "short.yaml");
}

TEST(MatchSection, IsReadInFull) {
  const auto read =
      with_match("rival: blue, begins_s: 12, first: rival, brackets_mph: [80, 115], " + kLanes +
                 ", attempts: [pass, cut_in], defends: [slow, hold], "
                 "expect: [passed, cut_in, early], result: rival");
  ASSERT_TRUE(read) << to_string(read.error());
  ASSERT_TRUE(read->match);
  const MatchPlan& plan = *read->match;
  EXPECT_EQ(plan.rival, "blue");
  EXPECT_EQ(plan.begins, seconds(12));
  EXPECT_TRUE(plan.rival_first);
  ASSERT_EQ(plan.rules.round_speeds_mph.size(), 2U);
  EXPECT_EQ(plan.rules.round_speeds_mph[1], 115.0);
  EXPECT_EQ(plan.attempts, (std::vector{traffic::Manner::kPass, traffic::Manner::kCutIn}));
  EXPECT_EQ(plan.defends, (std::vector{traffic::Defence::kSlow, traffic::Defence::kHold}));
  EXPECT_EQ(plan.expect,
            (std::vector{rules::Ending::kPassed, rules::Ending::kCutIn, rules::Ending::kEarly}));
  EXPECT_EQ(plan.result, "blue");
  ASSERT_TRUE(read->cars[0].ghost.lanes);
  EXPECT_EQ(read->cars[0].ghost.lanes->inside_m, 0.0);
  EXPECT_EQ(read->cars[0].ghost.lanes->outside_m, -5.0);
}

TEST(MatchSection, HasTheRoundSpeedsOfTheCompetitionByDefault) {
  const auto read = with_match("rival: blue, begins_s: 12, " + kLanes);
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->match->rules.round_speeds_mph.size(), rules::kRoundSpeeds_mph.size());
  EXPECT_FALSE(read->match->rival_first);
  EXPECT_EQ(read->match->attempts, std::vector{traffic::Manner::kPass});
}

TEST(MatchSection, IsAbsentFromOtherScenarios) {
  const auto read = read_scenario(
      "schema: 1\nname: short\nseed: 3\nduration_s: 20\ntrack: t.yaml\ncar: c.yaml\n"
      "race_control: [{at_s: 0.5, track: red}]\n",
      "short.yaml");
  ASSERT_TRUE(read);
  EXPECT_FALSE(read->match);
}

TEST(MatchSection, NamesWhatItRefuses) {
  const std::string good = "rival: blue, begins_s: 12, " + kLanes;
  for (const auto& [match, says] : std::vector<std::pair<std::string, std::string>>{
           {"rival: red, begins_s: 12, " + kLanes, "no other car has the name \"red\""},
           {"rival: blue, " + kLanes, "begins_s"},
           {"rival: blue, begins_s: 12", "lanes"},
           {"rival: blue, begins_s: 12, lanes: {inside_m: -5, outside_m: 0}", "outside_m"},
           {"rival: blue, begins_s: 0.5, " + kLanes, "has an entry after match.begins_s"},
           {good + ", first: blue", "not one of: own, rival"},
           {good + ", brackets_mph: [100, 80]", "must rise"},
           {good + ", brackets_mph: [80, 80]", "must rise"},
           {good + ", brackets_mph: [5]", "brackets_mph"},
           {good + ", attempts: [fly]",
            "not one of: pass, follow, cut_in, early, ram, open_door, "
            "decline"},
           {good + ", defends: [fly]", "not one of: hold, slow, wide"},
           {good + ", expect: [won]", "no ending"},
           {good + ", result: blue", "not one of: own, rival, draw, open"},
           {good + ", prize: 1", "prize"}}) {
    const auto read = with_match(match);
    ASSERT_FALSE(read) << match;
    EXPECT_NE(to_string(read.error()).find(says), std::string::npos)
        << match << ": " << to_string(read.error());
  }
}

TEST(MatchSection, LetsAStackDriveByItself) {
  const std::string good = "rival: blue, begins_s: 12, " + kLanes;
  const auto read = with_match(good, kStack);
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_FALSE(read->cars[0].ghost.lanes);
  EXPECT_FALSE(with_match(good + ", attempts: [pass]", kStack));
}

}  // namespace
}  // namespace pitwall::scenario
