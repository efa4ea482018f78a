// SPDX-License-Identifier: Apache-2.0
#include "hil/report/sweep/margin_charts.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <regex>

#include "hil/report/plot.hpp"
#include "tests/hil/report/sweep/some_sweep.hpp"

namespace pitwall::report {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<sweep::CaseResult> with_margins(const std::vector<double>& margins) {
  std::vector<sweep::CaseResult> results;
  for (std::size_t i = 0; i < margins.size(); ++i)
    results.push_back({.number = i, .margins = {{kGrip, margins[i], margins[i] >= 0.0}}});
  return results;
}

std::string charts_of(const std::vector<sweep::CaseResult>& results,
                      const std::vector<sweep::CaseResult>& before = {}) {
  const sweep::Cases cases = some_cases();
  return margin_charts({.cases = cases, .results = results, .command = ""},
                       spreads_by_failures(results), spreads_by_failures(before));
}

// Sum of the heights that the bars of this colour name.
double cases_in_bars(const std::string& html, const std::string& colour) {
  const std::regex bar{"fill=\"" + colour + R"re("[^>]*><title>([\d.]+) cases)re"};
  double sum = 0.0;
  for (std::sregex_iterator at{html.begin(), html.end(), bar}, end; at != end; ++at)
    sum += std::stod((*at)[1]);
  return sum;
}

TEST(MarginCharts, EveryMarginIsInABarAndWhatFailedInTheFailingColour) {
  const std::string html = charts_of(with_margins({-2.0, -0.001, 0.0, 1.0, 1.0, 3.0}));
  EXPECT_EQ(cases_in_bars(html, std::string{kSky.css}), 6.0) << html;
  EXPECT_EQ(cases_in_bars(html, std::string{kVermillion.css}), 2.0);
  EXPECT_NE(html.find("least: -2 (case 0)"), std::string::npos) << html;
  EXPECT_NE(html.find("median: 1<"), std::string::npos) << html;
  EXPECT_NE(html.find("failed: 2 of 6"), std::string::npos) << html;
}

TEST(MarginCharts, AMarginThatIsNotFiniteIsCountedAndNotDrawn) {
  const std::string html = charts_of(with_margins({-kInfinity, 1.0, 2.0}));
  EXPECT_EQ(cases_in_bars(html, std::string{kSky.css}), 2.0);
  EXPECT_NE(html.find("without a margin, not drawn: 1"), std::string::npos) << html;
  EXPECT_NE(html.find("failed: 1 of 3"), std::string::npos) << html;
  EXPECT_EQ(html.find("inf"), std::string::npos);
  EXPECT_NE(charts_of(with_margins({-kInfinity})).find("data-absent=\"margin1\""),
            std::string::npos);
}

TEST(MarginCharts, ZeroIsShownUnlessItIsFar) {
  const std::string far = "The limit, 0, is outside the axis";
  EXPECT_EQ(charts_of(with_margins({1.0, 2.0})).find(far), std::string::npos);
  EXPECT_NE(charts_of(with_margins({100.0, 101.0})).find(far), std::string::npos);
  EXPECT_NE(charts_of(with_margins({-100.0, -101.0})).find(far), std::string::npos);
}

TEST(MarginCharts, EqualMarginsHaveAnAxisToo) {
  for (const double margin : {0.0, 0.3, -7.0, 1e12}) {
    const std::string html = charts_of(with_margins({margin, margin * (1.0 + 1e-12)}));
    EXPECT_EQ(cases_in_bars(html, std::string{kSky.css}), 2.0) << margin;
    EXPECT_EQ(html.find("nan"), std::string::npos) << margin;
  }
}

TEST(MarginCharts, OneFailureAmongThousandsIsSeen) {
  std::vector<double> margins(5'000, 1.0);
  margins[7] = -1.0;
  const std::string html = charts_of(with_margins(margins));
  EXPECT_NE(html.find("Heights are logarithmic"), std::string::npos);
  const std::regex failed{"fill=\"" + std::string{kVermillion.css} +
                          R"re("[^>]* height="([\d.]+)")re"};
  std::smatch match;
  ASSERT_TRUE(std::regex_search(html, match, failed));
  EXPECT_GT(std::stod(match[1]), 5.0);
}

TEST(MarginCharts, MostFailuresStandFirstThenTheLeastMargin) {
  std::vector<sweep::CaseResult> results(2);
  for (sweep::CaseResult& of : results)
    of.margins = {{"a", 5.0, true}, {"b", kInfinity, true}, {"c", 2.0, true}, {"d", -0.1, false}};
  std::string order;
  for (const sweep::MarginSpread& of : spreads_by_failures(results)) order += of.text;
  EXPECT_EQ(order, "dcab");
}

TEST(MarginCharts, ManyExpectationsAreCounted) {
  std::vector<sweep::CaseResult> results(1);
  for (std::size_t i = 0; i < kExpectationsShown + 3; ++i)
    results[0].margins.push_back({"e" + std::to_string(i), 1.0, true});
  const std::string html = charts_of(results);
  EXPECT_EQ(occurrences(html, "<svg"), kExpectationsShown);
  EXPECT_NE(html.find("3 more expectations"), std::string::npos);
}

TEST(MarginCharts, TheBaselineIsOutlined) {
  const auto now = with_margins({-1.0, 1.0}), before = with_margins({4.0, 5.0});
  EXPECT_EQ(occurrences(charts_of(now, before), "<path class=\"mark\""),
            occurrences(charts_of(now), "<path class=\"mark\"") + 1);
}

}  // namespace
}  // namespace pitwall::report
