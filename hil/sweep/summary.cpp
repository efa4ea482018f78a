// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/summary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "hil/sweep/margins.hpp"
#include "hil/sweep/worst_cases.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::sweep {
namespace {

std::array<std::size_t, kCaseVerdicts> verdict_counts(std::span<const CaseResult> results) {
  std::array<std::size_t, kCaseVerdicts> counts{};
  for (const CaseResult& result : results) ++counts[static_cast<std::size_t>(result.verdict)];
  return counts;
}

std::string margins_text(std::span<const CaseResult> results) {
  const std::vector<MarginSpread> spreads = margin_spreads(results);
  if (spreads.empty()) return {};
  std::string text =
      formatted("%10s %10s %10s %7s  margin of\n", "least", "1 in 20", "median", "failed");
  const auto shown = [](double margin) {
    return std::isfinite(margin) ? formatted("%10.4g", margin) : formatted("%10s", "-");
  };
  for (const MarginSpread& of : spreads)
    text += shown(of.least()) + " " + shown(of.one_in_twenty()) + " " + shown(of.median()) +
            formatted(" %7zu  %s\n", of.failures, of.text.c_str());
  return text;
}

std::string worst_text(const Cases& cases, std::span<const CaseResult> results,
                       const std::string& one_case) {
  const std::vector<const CaseResult*> failed = failed_cases(results);
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

std::string verdicts_text(std::span<const CaseResult> results) {
  const auto counts = verdict_counts(results);
  std::string text;
  for (std::size_t k = 0; k < kCaseVerdicts; ++k)
    text +=
        formatted("%s%zu %s", k == 0 ? "" : ", ", counts[k], name_of(static_cast<CaseVerdict>(k)));
  return text;
}

std::string summary_json(const Plan& plan, std::span<const CaseResult> results) {
  json::Object out;
  out.text("name", plan.name).text("scenario", plan.scenario_file).number("cases", results.size());
  const auto counts = verdict_counts(results);
  for (std::size_t k = 0; k < kCaseVerdicts; ++k)
    out.number(name_of(static_cast<CaseVerdict>(k)), counts[k]);
  return out.str();
}

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
