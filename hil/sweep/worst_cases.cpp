// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/worst_cases.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::sweep {
namespace {

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

using Candidate = std::pair<double, const CaseResult*>;

bool comes_before(const Candidate& a, const Candidate& b) {
  return std::pair{a.first, a.second->number} < std::pair{b.first, b.second->number};
}

// The `most` least margins of each expectation among the cases that passed, ascending.
std::vector<std::vector<Candidate>> least_of_each(std::span<const CaseResult> results,
                                                  std::size_t most) {
  std::map<std::string_view, std::vector<Candidate>> by_text;
  for (const CaseResult& result : results) {
    if (result.verdict != CaseVerdict::kPassed) continue;
    for (const ExpectationMargin& of : result.margins)
      if (std::isfinite(of.margin)) by_text[of.text].push_back({of.margin, &result});
  }
  std::vector<std::vector<Candidate>> out;
  for (auto& [text, candidates] : by_text) {
    const std::size_t kept = std::min(most, candidates.size());
    std::ranges::partial_sort(candidates, candidates.begin() + static_cast<std::ptrdiff_t>(kept),
                              comes_before);
    candidates.resize(kept);
    out.push_back(std::move(candidates));
  }
  return out;
}

}  // namespace

std::vector<const CaseResult*> failed_cases(std::span<const CaseResult> results) {
  std::vector<Candidate> failed;
  for (const CaseResult& result : results)
    if (result.verdict != CaseVerdict::kPassed) failed.push_back({worst_margin(result), &result});
  std::ranges::stable_sort(failed, {}, &Candidate::first);
  std::vector<const CaseResult*> out;
  for (const Candidate& of : failed) out.push_back(of.second);
  return out;
}

std::vector<const CaseResult*> nearest_cases(std::span<const CaseResult> results,
                                             std::size_t most) {
  const std::vector<std::vector<Candidate>> least = least_of_each(results, most);
  std::vector<const CaseResult*> out;
  std::set<std::size_t> taken;
  for (std::size_t place = 0; place < most; ++place)
    for (const std::vector<Candidate>& candidates : least) {
      if (out.size() == most || place >= candidates.size()) continue;
      const CaseResult* of = candidates[place].second;
      if (taken.insert(of->number).second) out.push_back(of);
    }
  return out;
}

std::string failure_text(const CaseResult& result) {
  if (!result.why.empty()) return result.why;
  const ExpectationMargin* worst = nullptr;
  for (const ExpectationMargin& of : result.margins)
    if (!of.pass && (worst == nullptr || order_of(of.margin) < order_of(worst->margin)))
      worst = &of;
  if (worst == nullptr) return "a contact that the scenario does not expect";
  if (!std::isfinite(worst->margin)) return "not judged: " + worst->text;
  return formatted("margin %.4g: %s", worst->margin, worst->text.c_str());
}

}  // namespace pitwall::sweep
