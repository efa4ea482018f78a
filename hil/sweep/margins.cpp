// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/margins.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace pitwall::sweep {
namespace {

struct Collected {
  MarginSpread spread;
  double least = kUnset;

  void add(const CaseResult& result, const ExpectationMargin& of) {
    spread.failures += !of.pass;
    if (!std::isfinite(of.margin)) {
      ++spread.not_finite;
      return;
    }
    spread.all.push_back(of.margin);
    if (!of.pass) spread.failed.push_back(of.margin);
    if (of.margin >= least) return;  // never at the first, which is not set
    least = of.margin;
    spread.least_in = result.number;
  }
};

}  // namespace

std::vector<MarginSpread> margin_spreads(std::span<const CaseResult> results) {
  std::map<std::string, Collected> by_text;
  for (const CaseResult& result : results)
    for (const ExpectationMargin& of : result.margins) by_text[of.text].add(result, of);
  std::vector<MarginSpread> spreads;
  for (auto& [text, collected] : by_text) {
    MarginSpread& spread = collected.spread;
    spread.text = text;
    std::ranges::sort(spread.all);
    std::ranges::sort(spread.failed);
    spreads.push_back(std::move(spread));
  }
  return spreads;
}

}  // namespace pitwall::sweep
