// SPDX-License-Identifier: Apache-2.0
#include "hil/report/sweep/case_table.hpp"

#include <algorithm>
#include <cmath>

#include "hil/report/html.hpp"
#include "hil/report/text.hpp"
#include "hil/sweep/worst_cases.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::report {
namespace {

// nullptr where none is finite.
const sweep::ExpectationMargin* least_margin_of(const sweep::CaseResult& result) {
  const sweep::ExpectationMargin* least = nullptr;
  for (const sweep::ExpectationMargin& of : result.margins)
    if (std::isfinite(of.margin) && (least == nullptr || of.margin < least->margin)) least = &of;
  return least;
}

std::string row_of(const SweepRun& run, const sweep::CaseResult& result) {
  const bool passed = result.verdict == sweep::CaseVerdict::kPassed;
  std::string values;
  for (const yaml::Setting& of : run.cases.at(result.number).settings)
    values += "<span>" + escaped(of.path + " = " + of.value) + "</span> ";
  const sweep::ExpectationMargin* least = least_margin_of(result);
  const std::string passed_why = least == nullptr ? "" : least->text;
  return std::string("<tr class=\"") + (passed ? "held" : "broken") + "\">" +
         cell(case_link(run, result.number)) + cell(name_of(result.verdict), "state") +
         cell(least == nullptr ? "&ndash;" : significant(least->margin, 4)) +
         cell(escaped(passed ? passed_why : failure_text(result)), "word") +
         cell(values, "word values") + "</tr>\n";
}

}  // namespace

std::string case_link(const SweepRun& run, std::size_t number) {
  const std::string text = std::to_string(number);
  const auto page = run.pages.find(number);
  if (page == run.pages.end()) return text;
  return "<a href=\"" + escaped(page->second) + "\">" + text + "</a>";
}

std::string case_table(const SweepRun& run, std::span<const sweep::CaseResult* const> cases) {
  std::string out =
      "<table class=\"cases\"><thead><tr><th>case</th><th>verdict</th><th>least margin</th>"
      "<th>why, or whose margin</th><th>values</th></tr></thead><tbody>";
  for (const sweep::CaseResult* of : cases.first(std::min(cases.size(), kCasesShown)))
    out += row_of(run, *of);
  out += "</tbody></table>\n";
  if (cases.size() > kCasesShown)
    out += note(formatted("%zu more are in results.sqlite.", cases.size() - kCasesShown));
  return out;
}

}  // namespace pitwall::report
