// SPDX-License-Identifier: Apache-2.0
#include "hil/report/sweep/parameter_charts.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <regex>

#include "hil/report/plot.hpp"
#include "tests/hil/report/sweep/some_sweep.hpp"

namespace pitwall::report {
namespace {

// Of the first chart.
std::size_t dots_of(const std::string& html, Colour colour) {
  const std::regex path{"stroke=\"" + std::string(colour.css) +
                        R"re("[^>]*stroke-opacity[^>]* d="([^"]*)")re"};
  std::smatch match;
  return std::regex_search(html, match, path) ? occurrences(match[1], "M") : 0;
}

TEST(ParameterCharts, EachCaseIsADotInEachChart) {
  const sweep::Cases cases = some_cases();
  const auto results = some_results(cases);
  const std::string html = parameter_charts(cases, results, kGrip);
  EXPECT_EQ(occurrences(html, "<svg"), 2U) << "a range and a list of numbers";
  EXPECT_EQ(dots_of(html, kVermillion), failures_of(results));
  EXPECT_EQ(dots_of(html, kBlue), 40U - failures_of(results));
}

TEST(ParameterCharts, OfTooManyAllThatFailedAreDrawnFirst) {
  const sweep::Cases cases = some_cases(5'000);
  const auto results = some_results(cases);
  const std::size_t failures = failures_of(results);
  ASSERT_GT(failures, 500U);
  ASSERT_LT(failures, kDotsMost);
  const std::string html = parameter_charts(cases, results, kGrip);
  EXPECT_EQ(dots_of(html, kVermillion), failures);
  EXPECT_EQ(dots_of(html, kBlue), kDotsMost - failures);
  EXPECT_NE(html.find("2000 of 5000 cases are drawn"), std::string::npos);
  const std::string all_failed = parameter_charts(cases, some_results(cases, 9.0), kGrip);
  EXPECT_EQ(dots_of(all_failed, kVermillion), kDotsMost);
}

TEST(ParameterCharts, AFailureWithoutAMarginIsADotToo) {
  const sweep::Cases cases = some_cases();
  auto results = some_results(cases, 0.0);
  results[3].margins[0] = {kGrip, -std::numeric_limits<double>::infinity(), false};
  const std::string html = parameter_charts(cases, results, kGrip);
  EXPECT_EQ(dots_of(html, kInk), 1U);
  EXPECT_NE(html.find("failed without a margin, at the lower edge: 1"), std::string::npos);
}

TEST(ParameterCharts, WithoutANumberThereIsNoChart) {
  const sweep::Cases cases = cases_of(sweep::listed_plan("all", {2, 2}));
  EXPECT_NE(parameter_charts(cases, some_results(cases), kGrip).find("data-absent=\"parameters\""),
            std::string::npos);
}

}  // namespace
}  // namespace pitwall::report
