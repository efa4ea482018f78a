// SPDX-License-Identifier: Apache-2.0
#include "hil/report/sweep/sweep_page.hpp"

#include <gtest/gtest.h>

#include "tests/hil/report/sweep/some_sweep.hpp"

namespace pitwall::report {
namespace {

std::string page_of(const std::vector<sweep::CaseResult>& results,
                    const std::vector<sweep::CaseResult>& before = {}) {
  const sweep::Cases cases = some_cases();
  SweepRun run{.cases = cases, .results = results, .command = "pitwall-hil sweep <p.yaml>"};
  if (!before.empty()) run.baseline = {before, sweep::difference(before, results)};
  return sweep_page(run);
}

TEST(SweepPage, SaysWhatWasRunAndThatItIsASimulation) {
  const auto results = some_results(some_cases());
  const std::string html = page_of(results);
  for (const char* part :
       {"SIMULATION: no car was driven", "<h1>some</h1>", "hil/scenarios/grip_low.yaml", "40 of 40",
        "0.40 h", "pitwall-hil sweep &lt;p.yaml&gt;", "FAIL"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
  EXPECT_NE(html.find(std::to_string(failures_of(results)) + " failed"), std::string::npos);
}

TEST(SweepPage, NeedsNothingFromOutsideAndNamesNoTime) {
  auto results = some_results(some_cases());
  const std::string html = page_of(results);
  for (const char* outside : {"https://", "src=", "@import", "url("})
    EXPECT_EQ(html.find(outside), std::string::npos) << outside;
  for (sweep::CaseResult& of : results) of.wall_s = 7.0;
  EXPECT_EQ(page_of(results), html) << "what a run took is not in it";
}

TEST(SweepPage, WithABaselineOnlyWhatBecameWorseFails) {
  const auto cases = some_cases();
  const auto good = some_results(cases, 0.5), bad = some_results(cases, 0.9);
  EXPECT_NE(page_of(bad, bad).find("<strong>PASS"), std::string::npos);
  EXPECT_NE(page_of(bad, good).find("<strong>FAIL"), std::string::npos);
  EXPECT_NE(page_of(good).find("<strong>PASS"), std::string::npos);
  EXPECT_NE(page_of(bad).find("<strong>FAIL"), std::string::npos);
  EXPECT_EQ(page_of(bad).find("Difference to the baseline"), std::string::npos);
}

TEST(SweepPage, WhereAllPassedTheNearestToFailingAreListed) {
  const auto cases = some_cases();
  const auto passed = some_results(cases, 0.4), failed = some_results(cases, 0.7);
  EXPECT_NE(page_of(passed).find("Cases nearest to failing"), std::string::npos);
  EXPECT_EQ(worst_of(failed).size(), failures_of(failed));
  ASSERT_EQ(worst_of(passed).size(), 10U);
  const auto worst = worst_of(failed).front()->number;
  EXPECT_EQ(worst_of(passed).front()->number, worst) << "the least margin of all";
}

TEST(SweepPage, ASweepInWhichNothingWasJudgedHasAPage) {
  std::vector<sweep::CaseResult> results(40);
  for (std::size_t i = 0; i < results.size(); ++i)
    results[i] = {.number = i, .verdict = sweep::CaseVerdict::kRefused, .why = "no"};
  const std::string html = page_of(results);
  EXPECT_NE(html.find("data-absent=\"margins\""), std::string::npos);
  EXPECT_NE(html.find("40 refused"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::report
