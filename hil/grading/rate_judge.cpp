// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/rate_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pitwall::grading {
namespace {

constexpr Duration kShortestTick = milliseconds(1);

}  // namespace

RateJudge::RateJudge(const Expectation& expectation)
    : condition_(expectation.condition),
      span_(expectation.span),
      ring_(static_cast<std::size_t>(expectation.span / kShortestTick) + 2) {
  so_far_.margin = std::numeric_limits<double>::infinity();
}

void RateJudge::observe(const Tick& tick) {
  if (!tick.in_window) return;
  const Sample* earlier = earlier_than(tick.at);
  const bool undefined = std::isnan(tick.value);
  const double rate =
      earlier != nullptr ? std::abs(tick.value - earlier->value) / (tick.at - earlier->at).seconds()
                         : kUnset;
  keep(tick);
  if (earlier == nullptr && !undefined) return;
  ++so_far_.ticks;
  if (undefined) ++so_far_.undefined;
  so_far_.margin = std::min(so_far_.margin, margin(condition_, rate));
  if (!holds(condition_, rate) && !so_far_.first_violation) so_far_.first_violation = tick.at;
}

// Drops what is older than the sample to compare with.
const RateJudge::Sample* RateJudge::earlier_than(Instant now) {
  const Instant latest = now - span_;
  while (count_ > 1 && kept(1).at <= latest) {
    oldest_ = (oldest_ + 1) % ring_.size();
    --count_;
  }
  return count_ > 0 && kept(0).at <= latest ? &kept(0) : nullptr;
}

void RateJudge::keep(const Tick& tick) {
  if (count_ == ring_.size()) return;
  ring_[(oldest_ + count_) % ring_.size()] = {tick.at, tick.value};
  ++count_;
}

const RateJudge::Sample& RateJudge::kept(std::size_t age_rank) const {
  return ring_[(oldest_ + age_rank) % ring_.size()];
}

Verdict RateJudge::verdict() const {
  Verdict verdict = so_far_;
  if (so_far_.first_violation)
    verdict.reason = "violated at " + at_text(*so_far_.first_violation);
  else if (so_far_.ticks == 0)
    verdict.reason = "no two ticks in its window to compare";
  return verdict;
}

ExpectationState RateJudge::state() const {
  if (so_far_.first_violation) return ExpectationState::kFailed;
  return so_far_.ticks > 0 ? ExpectationState::kHolds : ExpectationState::kOpen;
}

}  // namespace pitwall::grading
