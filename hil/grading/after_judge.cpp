// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/after_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pitwall::grading {
namespace {

constexpr double kMost = std::numeric_limits<double>::infinity();

}  // namespace

AfterJudge::AfterJudge(const Expectation& expectation)
    : condition_(expectation.condition), trigger_(expectation.trigger), limit_(expectation.limit) {
  so_far_.margin = kMost;
}

// A trigger of the window may be answered after the window.
void AfterJudge::observe(const Tick& tick) {
  if (pending_ && tick.at > deadline_) {
    decide_trigger();
    if (!so_far_.first_violation) so_far_.first_violation = deadline_;
  }
  const bool triggered = holds(trigger_, tick.other);
  if (triggered && !trigger_was_ && tick.in_window) begin_trigger(tick.at);
  trigger_was_ = triggered;
  if (!pending_) return;
  ++so_far_.ticks;
  if (std::isnan(tick.value)) ++so_far_.undefined;
  best_ = std::max(best_, margin(condition_, tick.value));
  if (!holds(condition_, tick.value)) return;
  decide_trigger();
  const Duration left = deadline_ - tick.at;
  so_far_.time_left = std::min(so_far_.time_left.value_or(left), left);
}

// Only the oldest unanswered trigger is kept: an answer to it answers those that came later too,
// and when it fails the expectation has failed.
void AfterJudge::begin_trigger(Instant at) {
  ++so_far_.triggers;
  if (pending_) return;
  pending_ = true;
  deadline_ = at + limit_;
  best_ = -kMost;
}

void AfterJudge::decide_trigger() {
  pending_ = false;
  ++decided_;
  so_far_.margin = std::min(so_far_.margin, best_);
}

Verdict AfterJudge::verdict() const {
  Verdict verdict = so_far_;
  if (so_far_.first_violation)
    verdict.reason = "did not hold by " + at_text(*so_far_.first_violation);
  else if (so_far_.triggers == 0)
    verdict.reason = "the trigger never came";
  else if (decided_ == 0)
    verdict.reason = "the run ended before the limit had passed";
  return verdict;
}

ExpectationState AfterJudge::state() const {
  if (so_far_.first_violation) return ExpectationState::kFailed;
  return decided_ > 0 ? ExpectationState::kHolds : ExpectationState::kOpen;
}

}  // namespace pitwall::grading
