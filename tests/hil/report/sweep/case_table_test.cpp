// SPDX-License-Identifier: Apache-2.0
#include "hil/report/sweep/case_table.hpp"

#include <gtest/gtest.h>

#include "tests/hil/report/sweep/some_sweep.hpp"

namespace pitwall::report {
namespace {

std::string table_of(const std::vector<sweep::CaseResult>& results,
                     const std::map<std::size_t, std::string>& pages = {}) {
  const sweep::Cases cases = some_cases();
  std::vector<const sweep::CaseResult*> rows;
  for (const sweep::CaseResult& of : results) rows.push_back(&of);
  return case_table({.cases = cases, .results = results, .command = "", .pages = pages}, rows);
}

TEST(CaseTable, HasVerdictMarginReasonAndValues) {
  const std::string html =
      table_of({{.number = 2,
                 .verdict = sweep::CaseVerdict::kFailed,
                 .margins = {{kGrip, -0.25, false}, {kWind, 3.0, true}}},
                {.number = 5, .verdict = sweep::CaseVerdict::kRefused, .why = "<mass> below 0"}});
  EXPECT_NE(html.find("<td>-0.25</td>"), std::string::npos) << html;
  EXPECT_NE(html.find("margin -0.25: always grip &lt; 1"), std::string::npos) << html;
  EXPECT_NE(html.find("perturb.friction = " + some_cases().at(2).settings[0].value),
            std::string::npos)
      << html;
  EXPECT_NE(html.find("&lt;mass&gt; below 0"), std::string::npos) << html;
  EXPECT_NE(html.find("<td>&ndash;</td>"), std::string::npos) << "no margin";
}

TEST(CaseTable, OnlyACaseWithAPageHasALink) {
  const std::string html =
      table_of({{.number = 2}, {.number = 5}}, {{5, "pages/5/report.html?\"x"}});
  EXPECT_EQ(occurrences(html, "<a href"), 1U);
  EXPECT_NE(html.find("<a href=\"pages/5/report.html?&quot;x\">5</a>"), std::string::npos) << html;
}

TEST(CaseTable, OfManyTheFirstAreShown) {
  std::vector<sweep::CaseResult> results;
  for (std::size_t i = 0; i < kCasesShown + 4; ++i) results.push_back({.number = i});
  const std::string html = table_of(results);
  EXPECT_EQ(occurrences(html, "<tr class"), kCasesShown);
  EXPECT_NE(html.find("4 more are in results.sqlite"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::report
