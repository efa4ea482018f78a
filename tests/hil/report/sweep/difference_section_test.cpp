// SPDX-License-Identifier: Apache-2.0
#include "hil/report/sweep/difference_section.hpp"

#include <gtest/gtest.h>

#include "hil/report/sweep/margin_charts.hpp"
#include "tests/hil/report/sweep/some_sweep.hpp"

namespace pitwall::report {
namespace {

std::string section_of(double least_before, double least_now) {
  const sweep::Cases cases = some_cases();
  const auto before = some_results(cases, least_before), now = some_results(cases, least_now);
  return difference_section({.cases = cases,
                             .results = now,
                             .command = "",
                             .baseline = Baseline{before, sweep::difference(before, now)}},
                            spreads_by_failures(now), spreads_by_failures(before));
}

TEST(DifferenceSection, NamesTheCasesWhoseVerdictChanged) {
  const sweep::Cases cases = some_cases();
  const std::size_t before = failures_of(some_results(cases, 0.7)),
                    now = failures_of(some_results(cases, 0.9));
  ASSERT_GT(now, before);
  const std::string changed = ": " + std::to_string(now - before) + "</h3>";
  const std::string worse = section_of(0.7, 0.9), better = section_of(0.9, 0.7);
  EXPECT_NE(worse.find("Passed before and do not now" + changed), std::string::npos) << worse;
  EXPECT_NE(worse.find("data-absent=\"better\""), std::string::npos);
  EXPECT_NE(better.find("Pass now and did not before" + changed), std::string::npos) << better;
  EXPECT_NE(better.find("data-absent=\"worse\""), std::string::npos);
}

TEST(DifferenceSection, ShowsWhatEachMarginFellBy) {
  const std::string html = section_of(0.5, 0.75);
  EXPECT_NE(html.find("40 cases are in both sweeps; 0 of them are the same run"),
            std::string::npos);
  EXPECT_EQ(occurrences(html, "<td class=\"word\">always grip &lt; 1</td>"), 1U) << html;
  EXPECT_NE(html.find("<td class=\"word\">never wind &gt; 2</td><td>0</td><td>0</td><td>3</td>"
                      "<td>3</td><td>3</td><td>3</td><td>none</td>"),
            std::string::npos)
      << html;
}

TEST(DifferenceSection, TheSameRunsAreCounted) {
  EXPECT_NE(section_of(0.7, 0.7).find("40 of them are the same run"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::report
