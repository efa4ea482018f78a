// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/summary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::sweep {
namespace {

struct OfExpectation {
  std::vector<double> margins;  // that are finite
  std::size_t failed = 0;
};

// What is not finite sorts before all: it failed without having been judged.
double order_of(double margin) {
  return std::isfinite(margin) ? margin : -std::numeric_limits<double>::infinity();
}

// Of what failed; a case without an expectation that failed was refused or crashed.
double worst_margin(const CaseResult& result) {
  double worst = std::numeric_limits<double>::infinity();
  for (const ExpectationMargin& of : result.margins)
    if (!of.pass) worst = std::min(worst, order_of(of.margin));
  return result.margins.empty() ? -std::numeric_limits<double>::infinity() : worst;
}

std::string verdicts_text(std::span<const CaseResult> results) {
  std::array<std::size_t, kCaseVerdicts> counts{};
  for (const CaseResult& result : results) ++counts[static_cast<std::size_t>(result.verdict)];
  std::string text;
  for (std::size_t k = 0; k < kCaseVerdicts; ++k)
    text +=
        formatted("%s%zu %s", k == 0 ? "" : ", ", counts[k], name_of(static_cast<CaseVerdict>(k)));
  return text;
}

std::string margins_text(std::span<const CaseResult> results) {
  std::map<std::string, OfExpectation> by_text;
  for (const CaseResult& result : results)
    for (const ExpectationMargin& of : result.margins) {
      OfExpectation& all = by_text[of.text];
      all.failed += !of.pass;
      if (std::isfinite(of.margin)) all.margins.push_back(of.margin);
    }
  if (by_text.empty()) return {};
  std::string text =
      formatted("%10s %10s %10s %7s  margin of\n", "least", "1 in 20", "median", "failed");
  for (auto& [expectation, all] : by_text) {
    std::ranges::sort(all.margins);
    const std::size_t count = all.margins.size();
    const auto cell = [&](std::size_t place) {
      return formatted("%10s", count == 0 ? "-" : formatted("%.4g", all.margins[place]).c_str());
    };
    text += cell(0) + " " + cell(count / 20) + " " + cell(count / 2) +
            formatted(" %7zu  %s\n", all.failed, expectation.c_str());
  }
  return text;
}

std::string failure_text(const CaseResult& result) {
  if (!result.why.empty()) return result.why;
  const ExpectationMargin* worst = nullptr;
  for (const ExpectationMargin& of : result.margins)
    if (!of.pass && (worst == nullptr || order_of(of.margin) < order_of(worst->margin)))
      worst = &of;
  if (worst == nullptr) return "a contact that the scenario does not expect";
  return formatted("margin %.4g: %s", worst->margin, worst->text.c_str());
}

std::string worst_text(const Cases& cases, std::span<const CaseResult> results,
                       const std::string& one_case) {
  std::vector<const CaseResult*> failed;
  for (const CaseResult& result : results)
    if (result.verdict != CaseVerdict::kPassed) failed.push_back(&result);
  std::ranges::stable_sort(failed, {}, [](const CaseResult* of) { return worst_margin(*of); });
  std::string text;
  for (std::size_t i = 0; i < std::min(failed.size(), kWorstShown); ++i) {
    const CaseResult& result = *failed[i];
    text += formatted("case %zu %s: %s\n ", result.number, name_of(result.verdict),
                      failure_text(result).c_str());
    for (const yaml::Setting& of : cases.at(result.number).settings)
      text += " " + of.path + " = " + of.value;
    text += formatted("\n  %s --case %zu\n", one_case.c_str(), result.number);
  }
  if (failed.size() > kWorstShown)
    text += formatted("and %zu more that did not pass\n", failed.size() - kWorstShown);
  return text;
}

}  // namespace

std::string summary_of(const Cases& cases, std::span<const CaseResult> results,
                       const std::string& one_case) {
  double simulated_s = 0.0, wall_s = 0.0;
  for (const CaseResult& result : results)
    simulated_s += result.simulated_s, wall_s += result.wall_s;
  std::string text =
      formatted("%s: %zu of %zu cases of %s, simulation: ", cases.plan().name.c_str(),
                results.size(), cases.size(), cases.plan().scenario_file.c_str());
  text += verdicts_text(results) + "\n";
  if (wall_s > 0.0)
    text += formatted("%.0f s simulated in %.0f s of a processor each: %.1f times real time\n",
                      simulated_s, wall_s, simulated_s / wall_s);
  return text + margins_text(results) + worst_text(cases, results, one_case);
}

bool all_passed(std::span<const CaseResult> results) {
  return std::ranges::all_of(
      results, [](const CaseResult& of) { return of.verdict == CaseVerdict::kPassed; });
}

}  // namespace pitwall::sweep
