// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/within_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pitwall::grading {

WithinJudge::WithinJudge(const Expectation& expectation)
    : condition_(expectation.condition),
      deadline_(expectation.from.value_or(Instant{}) + expectation.limit) {
  so_far_.margin = -std::numeric_limits<double>::infinity();
}

void WithinJudge::observe(const Tick& tick) {
  if (!tick.in_window) return;
  ++so_far_.ticks;
  if (std::isnan(tick.value)) ++so_far_.undefined;
  if (tick.at > deadline_) {
    if (!so_far_.time_left) so_far_.first_violation = deadline_;
    return;
  }
  so_far_.margin = std::max(so_far_.margin, margin(condition_, tick.value));
  if (!so_far_.time_left && holds(condition_, tick.value)) so_far_.time_left = deadline_ - tick.at;
}

Verdict WithinJudge::verdict() const {
  Verdict verdict = so_far_;
  if (so_far_.first_violation)
    verdict.reason = "did not hold by " + at_text(*so_far_.first_violation);
  else if (so_far_.ticks == 0)
    verdict.reason = kNoTick;
  else if (!so_far_.time_left)
    verdict.reason = "the run ended and it had not held";
  return verdict;
}

ExpectationState WithinJudge::state() const {
  if (so_far_.first_violation) return ExpectationState::kFailed;
  return so_far_.time_left ? ExpectationState::kHolds : ExpectationState::kOpen;
}

}  // namespace pitwall::grading
