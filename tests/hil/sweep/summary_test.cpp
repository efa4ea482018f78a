// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/summary.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "protocol/json/json_value.hpp"
#include "tests/hil/sweep/plan_text.hpp"

namespace pitwall::sweep {
namespace {

Cases cases() { return Cases{*read_plan(drawn_plan(), "p.yaml")}; }

CaseResult with_margin(std::size_t number, double margin) {
  return {.number = number,
          .verdict = margin >= 0.0 ? CaseVerdict::kPassed : CaseVerdict::kFailed,
          .simulated_s = 10.0,
          .wall_s = 0.5,
          .margins = {{"always a < 1", margin, margin >= 0.0}}};
}

std::string summary(const std::vector<CaseResult>& results) {
  return summary_of(cases(), results, "sweep p.yaml");
}

TEST(SweepSummary, SaysHowManyPassedAndTheMargins) {
  std::vector<CaseResult> results;
  for (std::size_t i = 0; i < 40; ++i)
    results.push_back(with_margin(i, 0.5 + static_cast<double>(i)));
  const std::string text = summary(results);
  EXPECT_NE(text.find("some: 40 of 40 cases of hil/scenarios/grip_low.yaml, simulation: 40 passed"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("20.0 times real time"), std::string::npos) << text;
  EXPECT_NE(text.find("       0.5        2.5       20.5       0  always a < 1"), std::string::npos)
      << text;
  EXPECT_TRUE(all_passed(results));
}

TEST(SweepSummary, NamesTheWorstWithTheirValuesAndHowToRunThemAgain) {
  std::vector<CaseResult> results;
  for (std::size_t i = 0; i < 10; ++i)
    results.push_back(with_margin(i, i % 2 == 0 ? 1.0 : -static_cast<double>(i)));
  const std::string text = summary(results);
  const std::size_t worst = text.find("case 9 failed: margin -9: always a < 1"),
                    second = text.find("case 7 failed: margin -7");
  EXPECT_LT(worst, second) << text;
  const yaml::Setting friction = cases().at(9).settings[0];
  EXPECT_NE(text.find("perturb.friction = " + friction.value), std::string::npos) << text;
  EXPECT_NE(text.find("sweep p.yaml --case 9"), std::string::npos) << text;
  EXPECT_FALSE(all_passed(results));
}

TEST(SweepSummary, ShowsOnlyTheFirstOfMany) {
  std::vector<CaseResult> results;
  for (std::size_t i = 0; i < 12; ++i) results.push_back(with_margin(i, -1.0));
  EXPECT_NE(summary(results).find("and 7 more that did not pass"), std::string::npos);
}

TEST(SweepSummary, ARefusalAndACrashAreNamedFirst) {
  const std::vector<CaseResult> results{
      with_margin(0, -5.0), {.number = 1, .verdict = CaseVerdict::kRefused, .why = "out of range"}};
  const std::string text = summary(results);
  EXPECT_LT(text.find("case 1 refused: out of range"), text.find("case 0 failed")) << text;
}

TEST(SweepSummary, AMarginThatIsNotFiniteIsNoQuantile) {
  std::vector<CaseResult> results{with_margin(0, 2.0), with_margin(1, 3.0)};
  results[1].margins[0] = {"always a < 1", -std::numeric_limits<double>::infinity(), false};
  results[1].verdict = CaseVerdict::kFailed;
  const std::string text = summary(results);
  EXPECT_NE(text.find("         2          2          2       1  always a < 1"), std::string::npos)
      << text;
}

TEST(SweepSummary, ProgramsReadTheCounts) {
  const std::vector<CaseResult> results{with_margin(0, 2.0), with_margin(1, -3.0),
                                        with_margin(2, 1.0)};
  const auto json = json::JsonValue::parse(summary_json(cases().plan(), results), "summary");
  ASSERT_TRUE(json);
  EXPECT_EQ(json->text("name"), "some");
  EXPECT_EQ(json->text("scenario"), "hil/scenarios/grip_low.yaml");
  EXPECT_EQ(json->number("cases"), 3.0);
  EXPECT_EQ(json->number("passed"), 2.0);
  EXPECT_EQ(json->number("failed"), 1.0);
  EXPECT_EQ(json->number("crashed"), 0.0);
}

}  // namespace
}  // namespace pitwall::sweep
