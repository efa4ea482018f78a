// SPDX-License-Identifier: Apache-2.0
#include "hil/report/sweep/coverage_tables.hpp"

#include <algorithm>
#include <vector>

#include "hil/report/absent.hpp"
#include "hil/report/html.hpp"
#include "hil/report/sweep/parameter_axis.hpp"
#include "hil/report/text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::report {
namespace {

struct CellCount {
  std::size_t run = 0, failed = 0;
};

// Two parameters, by their place in the plan, and the cases in each combination of their bins.
struct Pair {
  std::size_t row, column;
  std::vector<CellCount> counts;  // row by row
};

std::vector<Pair> pairs_of(const std::vector<ParameterAxis>& axes) {
  std::vector<Pair> pairs;
  for (std::size_t row = 0; row < axes.size(); ++row)
    for (std::size_t column = row + 1; column < axes.size(); ++column)
      if (axes[row].varies() && axes[column].varies())
        pairs.push_back(
            {row, column,
             std::vector<CellCount>(axes[row].bins().size() * axes[column].bins().size())});
  return pairs;
}

void count(const std::vector<ParameterAxis>& axes, const sweep::Cases& cases, CaseResults results,
           std::vector<Pair>& pairs) {
  std::vector<std::size_t> bins(axes.size());
  for (const sweep::CaseResult& result : results) {
    const sweep::Case of = cases.at(result.number);
    for (std::size_t k = 0; k < axes.size(); ++k) bins[k] = axes[k].bin_of(of.settings[k].value);
    for (Pair& pair : pairs) {
      const std::size_t columns = axes[pair.column].bins().size();
      CellCount& counted = pair.counts[bins[pair.row] * columns + bins[pair.column]];
      ++counted.run;
      counted.failed += result.verdict != sweep::CaseVerdict::kPassed;
    }
  }
}

std::string cell_of(const CellCount& counted) {
  if (counted.run == 0) return cell("&ndash;", "none");
  const std::string run = std::to_string(counted.run);
  if (counted.failed == 0) return cell(run);
  const std::size_t third = std::min<std::size_t>(3 * counted.failed / counted.run, 2);
  return cell(run + formatted(" <b>&times;%zu</b>", counted.failed),
              formatted("failed%zu", third + 1));
}

std::string table_of(const Pair& pair, const ParameterAxis& rows, const ParameterAxis& columns) {
  const auto not_run = std::ranges::count(pair.counts, std::size_t{0}, &CellCount::run);
  std::string out = formatted(
      "<table class=\"coverage\"><caption><b>%s</b> downwards, <b>%s</b> across: %zu of %zu "
      "combinations not run</caption><thead><tr><th></th>",
      escaped(rows.path()).c_str(), escaped(columns.path()).c_str(),
      static_cast<std::size_t>(not_run), pair.counts.size());
  for (const std::string& name : columns.bins()) out += "<th>" + escaped(name) + "</th>";
  out += "</tr></thead><tbody>";
  for (std::size_t row = 0; row < rows.bins().size(); ++row) {
    out += "<tr><th>" + escaped(rows.bins()[row]) + "</th>";
    for (std::size_t column = 0; column < columns.bins().size(); ++column)
      out += cell_of(pair.counts[row * columns.bins().size() + column]);
    out += "</tr>\n";
  }
  return out + "</tbody></table>\n";
}

}  // namespace

std::string coverage_tables(const sweep::Cases& cases, CaseResults results) {
  std::vector<ParameterAxis> axes;
  for (const sweep::Parameter& parameter : cases.plan().parameters) axes.emplace_back(parameter);
  std::vector<Pair> pairs = pairs_of(axes);
  if (pairs.empty())
    return absent("coverage", "Combinations", "fewer than two parameters have several values");
  const std::size_t all = pairs.size();
  pairs.resize(std::min(all, kPairsShown));
  count(axes, cases, results, pairs);
  std::vector<std::string> tables;
  for (const Pair& pair : pairs)
    tables.push_back(table_of(pair, axes[pair.row], axes[pair.column]));
  std::string out = in_two_columns(tables);
  if (all > pairs.size())
    out += note(formatted("%zu more pairs of parameters are not shown.", all - pairs.size()));
  return out;
}

}  // namespace pitwall::report
