// SPDX-License-Identifier: Apache-2.0
#include "hil/report/sweep/coverage_tables.hpp"

#include <gtest/gtest.h>

#include <regex>

#include "tests/hil/report/sweep/some_sweep.hpp"

namespace pitwall::report {
namespace {

std::size_t sum_of(const std::string& html, const std::regex& pattern) {
  std::size_t sum = 0;
  for (std::sregex_iterator at{html.begin(), html.end(), pattern}, end; at != end; ++at)
    sum += std::stoul((*at)[1]);
  return sum;
}

TEST(CoverageTables, EveryCaseAndEveryFailureIsInOneCell) {
  const sweep::Cases cases = some_cases(200);
  const auto results = some_results(cases);
  const std::string html = coverage_tables(cases, results);
  EXPECT_EQ(occurrences(html, "<table"), 1U);
  EXPECT_EQ(sum_of(html, std::regex{R"(<td[^>]*>(\d+))"}), 200U);
  EXPECT_EQ(sum_of(html, std::regex{R"(&times;(\d+))"}), failures_of(results));
  EXPECT_GT(failures_of(results), 10U);
  EXPECT_NE(html.find("<th>0.5 to 0.625</th>"), std::string::npos) << "a range, in parts";
  EXPECT_NE(html.find("<th>8</th>"), std::string::npos) << "a listed value";
}

TEST(CoverageTables, ACombinationThatWasNotRunIsCounted) {
  const sweep::Cases cases = cases_of(sweep::listed_plan("all", {2, 3}));
  std::vector<sweep::CaseResult> results = some_results(cases);
  results.resize(4);
  const std::string html = coverage_tables(cases, results);
  EXPECT_NE(html.find("2 of 6 combinations not run"), std::string::npos) << html;
  EXPECT_EQ(occurrences(html, "class=\"none\""), 2U);
}

TEST(CoverageTables, EveryTwoParametersHaveATableUpToALimit) {
  const sweep::Cases four = cases_of(sweep::listed_plan("pairs", {2, 2, 1, 2})),
                     many = cases_of(sweep::listed_plan("pairs", std::vector<int>(20, 2)));
  EXPECT_EQ(occurrences(coverage_tables(four, some_results(four)), "<table"), 3U)
      << "what has one value is in none";
  const std::string html = coverage_tables(many, some_results(many));
  EXPECT_EQ(occurrences(html, "<table"), kPairsShown);
  EXPECT_NE(html.find("70 more pairs"), std::string::npos);
}

TEST(CoverageTables, OneParameterAloneMeetsNone) {
  const sweep::Cases cases = cases_of(sweep::listed_plan("all", {3}));
  EXPECT_NE(coverage_tables(cases, some_results(cases)).find("data-absent=\"coverage\""),
            std::string::npos);
}

}  // namespace
}  // namespace pitwall::report
