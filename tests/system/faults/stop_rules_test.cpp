// Each stop rule of the paper in the whole car, at race speed: the rule itself stops it, in its own
// time, and the car ends on the track. And no rule of the paper without a scenario.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/bench/lockstep/lockstep.hpp"
#include "vehicle/safety/causes.hpp"

namespace pitwall::bench {
namespace {

using safety::Cause;

const std::string kRoot = PITWALL_SOURCE_DIR;
const std::string kFolder = kRoot + "/hil/scenarios/stop_rules";
// Positions that do not fit are refused for a second before they are believed and corrected.
constexpr Duration kRefusal = milliseconds(1380);

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder))
    all.push_back(entry.path().stem().string());
  std::ranges::sort(all);
  return all;
}

Result<Loaded, Problem> loaded(const std::string& name) {
  return load(kFolder + "/" + name + ".yaml", kRoot);
}

// The expectation that says which rule stops the car, and by when.
std::optional<grading::Expectation> rule_of(const scenario::Scenario& scenario) {
  for (const grading::Expectation& e : scenario.expect)
    if (e.kind == grading::Kind::kWithin && e.condition.signal == "stop_cause" &&
        e.condition.op == grading::Op::kEqual)
      return e;
  return std::nullopt;
}

class StopRule : public ::testing::TestWithParam<std::string> {};

TEST_P(StopRule, StopsTheCarByItself) {
  const auto scenario = loaded(GetParam());
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  EXPECT_EQ(scenario->scenario.name, GetParam()) << "a scenario is called as its file";
  const auto run = run_lockstep(scenario->scenario, scenario->setup, {});
  ASSERT_TRUE(run) << to_string(run.error());
  for (const grading::Verdict& verdict : run->verdicts)
    EXPECT_TRUE(verdict.pass) << verdict.name << ": " << verdict.text << ": " << verdict.reason;
}

INSTANTIATE_TEST_SUITE_P(All, StopRule, ::testing::ValuesIn(names()),
                         [](const auto& name) { return name.param; });

// Of which rule a scenario is, from where its deadline counts, and what else it has to ask.
TEST(StopRules, EachOfThePapersHasAScenarioWithItsOwnDeadline) {
  std::map<Cause, std::string> covered;
  for (const std::string& name : names()) {
    const auto scenario = loaded(name);
    ASSERT_TRUE(scenario) << to_string(scenario.error());
    const auto rule = rule_of(scenario->scenario);
    ASSERT_TRUE(rule) << name << ": does not say which rule stops the car";
    const auto cause = static_cast<Cause>(static_cast<int>(rule->condition.number));
    const safety::CauseRow& row = safety::row_of(cause);
    EXPECT_TRUE(row.listed_in_paper) << name << ": " << row.text;
    EXPECT_TRUE(covered.emplace(cause, name).second) << name << ": a second one of its rule";
    const Duration extra = cause == Cause::kLocalizationUncertain ? kRefusal : Duration{};
    EXPECT_LE(*rule->to - *rule->from, row.deadline + extra) << name;
    EXPECT_TRUE(
        std::ranges::any_of(scenario->scenario.faults,
                            [&](const auto& fault) { return Instant{} + fault.at == rule->from; }))
        << name << ": no fault begins where the deadline does";
    for (const char* asked : {"contact", "wall_gap_m", "speed_mps"})
      EXPECT_TRUE(std::ranges::any_of(scenario->scenario.expect,
                                      [&](const auto& e) { return e.condition.signal == asked; }))
          << name << ": " << asked;
  }
  for (const safety::CauseRow& row : safety::kCauseTable) {
    EXPECT_TRUE(!row.listed_in_paper || covered.contains(row.cause)) << "no scenario: " << row.text;
  }
}

// Without its fault none of them is a stop.
TEST(StopRules, WithoutItsFaultNoRuleStops) {
  auto scenario = loaded(names().front());
  ASSERT_TRUE(scenario);
  scenario->scenario.faults.clear();
  scenario->scenario.duration = seconds(60);
  scenario->scenario.expect.clear();
  Cause stopped_by = Cause::kNone;
  LockstepOptions options;
  options.watch = [&](const pipeline::Outputs& out, const Rig&, Instant) {
    if (out.chosen.cause != Cause::kNone) stopped_by = out.chosen.cause;
  };
  ASSERT_TRUE(run_lockstep(scenario->scenario, scenario->setup, options));
  EXPECT_EQ(stopped_by, Cause::kNone) << safety::text_of(stopped_by);
}

}  // namespace
}  // namespace pitwall::bench
