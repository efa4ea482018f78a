// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/quantile_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "protocol/vocabulary/quantile.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::grading {
namespace {

constexpr double kBeyondAll = std::numeric_limits<double>::infinity();
constexpr Duration kUsualTick = milliseconds(10);

std::size_t ticks_of(const Expectation& e) {
  if (!e.to) return 0;
  return static_cast<std::size_t>((*e.to - e.from.value_or(Instant{})) / kUsualTick) + 1;
}

}  // namespace

QuantileJudge::QuantileJudge(const Expectation& expectation)
    : condition_(expectation.condition),
      share_(expectation.share),
      is_upper_(condition_.op == Op::kLess || condition_.op == Op::kLessEqual) {
  values_.reserve(ticks_of(expectation));
}

void QuantileJudge::observe(const Tick& tick) {
  if (!tick.in_window) return;
  const bool undefined = std::isnan(tick.value);
  if (undefined) ++undefined_;
  values_.push_back(!undefined ? tick.value : is_upper_ ? kBeyondAll : -kBeyondAll);
  if (holds(condition_, tick.value)) ++met_;
}

double QuantileJudge::quantile() const {
  std::vector<double> values = values_;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(nearest_rank(share_, values.size()));
  std::ranges::nth_element(values, at);
  return *at;
}

// The value of rank k (from 0) is below a limit if more than k values are, and above it if no more
// than k are not.
bool QuantileJudge::is_met() const {
  const std::size_t rank = nearest_rank(share_, values_.size());
  return is_upper_ ? met_ > rank : values_.size() - met_ <= rank;
}

Verdict QuantileJudge::verdict() const {
  Verdict verdict;
  verdict.ticks = values_.size();
  verdict.undefined = undefined_;
  verdict.margin = -kBeyondAll;
  verdict.reason = kNoTick;
  if (values_.empty()) return verdict;
  const double value = quantile();
  verdict.margin = margin(condition_, value);
  verdict.reason = is_met() ? "" : formatted("the quantile is %.6g", value);
  return verdict;
}

ExpectationState QuantileJudge::state() const {
  return !values_.empty() && is_met() ? ExpectationState::kHolds : ExpectationState::kOpen;
}

}  // namespace pitwall::grading
