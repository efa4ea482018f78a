// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/until_judge.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::grading {

UntilJudge::UntilJudge(const Expectation& expectation)
    : condition_(expectation.condition),
      release_(expectation.release),
      deadline_(expectation.from.value_or(Instant{}) + expectation.limit) {
  so_far_.margin = -std::numeric_limits<double>::infinity();
}

void UntilJudge::observe(const Tick& tick) {
  if (!tick.in_window) return;
  const bool is_decided = so_far_.time_left || so_far_.first_violation;
  if (tick.at > deadline_) {
    if (is_decided) return;
    is_late_ = true;
    so_far_.first_violation = deadline_;
    return;
  }
  ++so_far_.ticks;
  if (std::isnan(tick.value) || std::isnan(tick.other)) ++so_far_.undefined;
  so_far_.margin = std::max(so_far_.margin, std::min(margin(release_, tick.other), least_));
  least_ = std::min(least_, margin(condition_, tick.value));
  if (is_decided) return;
  if (holds(release_, tick.other))
    so_far_.time_left = deadline_ - tick.at;
  else if (!holds(condition_, tick.value))
    so_far_.first_violation = tick.at;
}

Verdict UntilJudge::verdict() const {
  Verdict verdict = so_far_;
  if (is_late_)
    verdict.reason = "was not released by " + at_text(*so_far_.first_violation);
  else if (so_far_.first_violation)
    verdict.reason = "violated at " + at_text(*so_far_.first_violation) + ", before its release";
  else if (so_far_.ticks == 0)
    verdict.reason = kNoTick;
  else if (!so_far_.time_left)
    verdict.reason = "the run ended before its release";
  return verdict;
}

ExpectationState UntilJudge::state() const {
  if (so_far_.first_violation) return ExpectationState::kFailed;
  return so_far_.time_left ? ExpectationState::kHolds : ExpectationState::kOpen;
}

}  // namespace pitwall::grading
