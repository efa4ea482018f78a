// SPDX-License-Identifier: Apache-2.0
#include "hil/report/sweep/difference_section.hpp"

#include <algorithm>
#include <cmath>

#include "hil/report/absent.hpp"
#include "hil/report/html.hpp"
#include "hil/report/sweep/case_table.hpp"
#include "hil/report/sweep/margin_charts.hpp"
#include "hil/report/text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::report {
namespace {

using sweep::MarginSpread;

std::string figure_of(double margin) {
  return std::isfinite(margin) ? significant(margin, 4) : "&ndash;";
}

std::string from_to(double before, double now) {
  return cell(figure_of(before)) + cell(figure_of(now));
}

std::string changed_cases(const SweepRun& run, const std::string& name, const std::string& title,
                          const std::vector<std::size_t>& numbers) {
  if (numbers.empty()) return absent(name, title, "none");
  std::vector<const sweep::CaseResult*> cases;
  for (const std::size_t number : numbers) cases.push_back(&sweep::result_of(run.results, number));
  return "<h3>" + escaped(title) + formatted(": %zu</h3>\n", numbers.size()) +
         case_table(run, cases);
}

std::string fall_row(const SweepRun& run, const MarginSpread& now, const MarginSpread& before) {
  const sweep::Difference& difference = run.baseline->difference;
  std::string row = "<tr>" + cell(escaped(now.text), "word") +
                    cell(std::to_string(before.failures)) + cell(std::to_string(now.failures)) +
                    from_to(before.least(), now.least()) + from_to(before.median(), now.median());
  const auto fall = difference.falls.find(now.text);
  if (fall == difference.falls.end()) return row + cell("none") + cell("") + "</tr>\n";
  const auto& [number, from, to] = fall->second;
  return row + cell(figure_of(from) + " to " + figure_of(to)) + cell(case_link(run, number)) +
         "</tr>\n";
}

}  // namespace

std::string difference_section(const SweepRun& run, const std::vector<MarginSpread>& now,
                               const std::vector<MarginSpread>& before) {
  const sweep::Difference& difference = run.baseline->difference;
  std::string out = note(formatted(
      "%zu cases are in both sweeps; %zu of them are the same run, with the same event log.",
      difference.compared, difference.unchanged));
  out += changed_cases(run, "worse", "Passed before and do not now", difference.worse);
  out += changed_cases(run, "better", "Pass now and did not before", difference.better);
  out +=
      "<h3>Margins</h3>\n<table class=\"falls\"><thead><tr><th rowspan=\"2\">expectation</th>"
      "<th colspan=\"2\">failed</th><th colspan=\"2\">least margin</th>"
      "<th colspan=\"2\">median margin</th><th colspan=\"2\">fell most</th></tr><tr>"
      "<th>before</th><th>now</th><th>before</th><th>now</th><th>before</th><th>now</th>"
      "<th>from, to</th><th>in case</th></tr></thead><tbody>";
  for (std::size_t i = 0; i < std::min(now.size(), kExpectationsShown); ++i)
    if (const MarginSpread* same = spread_of(before, now[i].text))
      out += fall_row(run, now[i], *same);
  return out + "</tbody></table>\n";
}

}  // namespace pitwall::report
