// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/detects_judge.hpp"

namespace pitwall::grading {

DetectsJudge::DetectsJudge(const Expectation& expectation)
    : condition_(expectation.condition),
      fault_(*expectation.from),
      limit_(expectation.limit),
      within_(expectation) {}

void DetectsJudge::observe(const Tick& tick) {
  if (tick.at > fault_) return within_.observe(tick);
  held_before_ |= tick.at >= fault_ - kQuiet && holds(condition_, tick.value);
}

Verdict DetectsJudge::verdict() const {
  Verdict verdict = within_.verdict();
  if (verdict.time_left) verdict.delay = limit_ - *verdict.time_left;
  if (held_before_ && !verdict.first_violation) verdict.reason = "it held before the fault began";
  return verdict;
}

ExpectationState DetectsJudge::state() const {
  return held_before_ ? ExpectationState::kFailed : within_.state();
}

}  // namespace pitwall::grading
