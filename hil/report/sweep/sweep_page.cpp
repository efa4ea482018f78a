// SPDX-License-Identifier: Apache-2.0
#include "hil/report/sweep/sweep_page.hpp"

#include <algorithm>
#include <string_view>

#include "hil/report/html.hpp"
#include "hil/report/sweep/case_table.hpp"
#include "hil/report/sweep/coverage_tables.hpp"
#include "hil/report/sweep/difference_section.hpp"
#include "hil/report/sweep/margin_charts.hpp"
#include "hil/report/sweep/parameter_charts.hpp"
#include "hil/report/text.hpp"
#include "hil/sweep/summary.hpp"
#include "hil/sweep/worst_cases.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::report {
namespace {

using sweep::MarginSpread;

constexpr std::string_view kSweepStyle = R"css(
h3 { margin: 16px 0 4px; font-size: 14px; overflow-wrap: anywhere; }
.values span { white-space: nowrap; margin-right: 10px; }
.cases td:nth-child(3), .cases th:nth-child(3) { text-align: right; }
.falls th:not(:first-child), .falls td:not(:first-child) { text-align: right; }
.coverage { table-layout: fixed; margin: 0 0 16px; font-size: 12px; }
.coverage caption { text-align: left; padding: 4px 0; font-size: 13px; overflow-wrap: anywhere; }
.coverage th { border-bottom: 1px solid #e3e8ec; padding: 3px 4px; overflow-wrap: anywhere; }
.coverage th:first-child { width: 92px; }
.coverage td { text-align: center; vertical-align: middle; padding: 3px 2px;
  border: 1px solid #fff; background: #dcecf6; }
.coverage td b { color: #8c1610; white-space: nowrap; }
.coverage .none { background: #f1f3f5; color: #55606b; }
.coverage .failed1 { background: #fdecea; }
.coverage .failed2 { background: #fbd9d5; }
.coverage .failed3 { background: #f7c3bd; }
)css";

constexpr std::string_view kCoverageNote =
    "A cell: how many cases were run with this combination of values; after the cross, how many of "
    "them did not pass. A range has eight equal parts, a list of more than eight values eight "
    "groups.";

const char* combination_of(sweep::Combine combine) {
  switch (combine) {
    case sweep::Combine::kDraw:
      return "drawn";
    case sweep::Combine::kAll:
      return "every combination";
    case sweep::Combine::kPairs:
      return "every pair of values";
  }
  return "";
}

std::string header_of(const SweepRun& run) {
  const sweep::Plan& plan = run.cases.plan();
  double simulated_s = 0.0;
  for (const sweep::CaseResult& of : run.results) simulated_s += of.simulated_s;
  return "<header><p class=\"simulation\">" + std::string(kSimulated) + "</p><h1>" +
         escaped(plan.name) + "</h1>\n<dl>" + fact("scenario", plan.scenario_file) +
         fact("cases", formatted("%zu of %zu", run.results.size(), run.cases.size())) +
         fact("values", combination_of(plan.combine)) + fact("seed", std::to_string(plan.seed)) +
         fact("simulated", number(simulated_s / 3600.0, 2) + " h") + fact("command", run.command) +
         "</dl></header>\n";
}

std::string banner_of(const SweepRun& run) {
  const sweep::Difference* difference = run.baseline ? &run.baseline->difference : nullptr;
  const bool good = passed(run);
  std::string out = std::string("<section class=\"banner ") + (good ? "pass" : "fail") +
                    "\" id=\"verdict\"><strong>" + (good ? "PASS" : "FAIL") + "</strong> " +
                    sweep::verdicts_text(run.results);
  if (difference != nullptr)
    out += formatted(
        "<p>Against the baseline: %zu passed before and do not now, %zu pass now and "
        "did not before.</p>",
        difference->worse.size(), difference->better.size());
  return out + "</section>\n";
}

}  // namespace

bool passed(const SweepRun& run) {
  return run.baseline ? run.baseline->difference.worse.empty() : sweep::all_passed(run.results);
}

std::vector<const sweep::CaseResult*> worst_of(CaseResults results) {
  std::vector<const sweep::CaseResult*> failed = sweep::failed_cases(results);
  return failed.empty() ? sweep::nearest_cases(results, kCasesShown) : failed;
}

std::string sweep_page(const SweepRun& run) {
  const std::vector<MarginSpread> spreads = spreads_by_failures(run.results);
  std::vector<MarginSpread> before;
  if (run.baseline) before = sweep::margin_spreads(run.baseline->results);
  std::string out = header_of(run) + banner_of(run);
  if (run.baseline)
    out += section("Difference to the baseline", difference_section(run, spreads, before));
  out += section(sweep::all_passed(run.results) ? "Cases nearest to failing" : "Worst cases",
                 note("A number with a link leads to the page of that case.") +
                     case_table(run, worst_of(run.results)));
  out += section("Margins", margin_charts(run, spreads, before));
  if (!spreads.empty())
    out += section("Margin by parameter",
                   parameter_charts(run.cases, run.results, spreads.front().text));
  out += section("Combinations that were run",
                 note(kCoverageNote) + coverage_tables(run.cases, run.results));
  return document(run.cases.plan().name + " sweep", out, kSweepStyle);
}

}  // namespace pitwall::report
