// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/baseline.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::sweep {
namespace {

constexpr std::size_t kNumbersShown = 10;

bool passed(const CaseResult& result) { return result.verdict == CaseVerdict::kPassed; }

void compare_margins(const CaseResult& before, const CaseResult& now, Difference& out) {
  for (const ExpectationMargin& of : now.margins) {
    const auto same = std::ranges::find(before.margins, of.text, &ExpectationMargin::text);
    if (same == before.margins.end() || !std::isfinite(of.margin) || !std::isfinite(same->margin))
      continue;
    const double fall = same->margin - of.margin;
    if (!(fall > 0.0)) continue;
    const auto known = out.falls.find(of.text);
    if (known == out.falls.end() || fall > known->second.before - known->second.now)
      out.falls[of.text] = {now.number, same->margin, of.margin};
  }
}

std::string numbers_text(const char* what, const std::vector<std::size_t>& numbers) {
  std::string text = formatted("%zu %s", numbers.size(), what);
  for (std::size_t i = 0; i < std::min(numbers.size(), kNumbersShown); ++i)
    text += formatted("%s%zu", i == 0 ? ": " : ", ", numbers[i]);
  return text + (numbers.size() > kNumbersShown ? ", ...\n" : "\n");
}

}  // namespace

Difference difference(std::span<const CaseResult> before, std::span<const CaseResult> now) {
  Difference out;
  auto other = before.begin();
  for (const CaseResult& result : now) {
    while (other != before.end() && other->number < result.number) ++other;
    if (other == before.end()) break;
    if (other->number != result.number) continue;
    ++out.compared;
    out.unchanged += !result.digest.empty() && result.digest == other->digest;
    if (passed(*other) && !passed(result)) out.worse.push_back(result.number);
    if (!passed(*other) && passed(result)) out.better.push_back(result.number);
    compare_margins(*other, result, out);
  }
  return out;
}

std::string to_text(const Difference& difference) {
  std::string text = formatted("against the baseline: %zu cases, %zu of them the same run\n",
                               difference.compared, difference.unchanged);
  text += numbers_text("passed before and do not now", difference.worse);
  text += numbers_text("pass now and did not before", difference.better);
  for (const auto& [expectation, fall] : difference.falls)
    text += formatted("margin fell most, %.4g to %.4g in case %zu: %s\n", fall.before, fall.now,
                      fall.number, expectation.c_str());
  return text;
}

}  // namespace pitwall::sweep
