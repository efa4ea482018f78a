// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/always_judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pitwall::grading {

AlwaysJudge::AlwaysJudge(const Expectation& expectation)
    : condition_(expectation.condition), wanted_(expectation.kind == Kind::kAlways) {
  so_far_.margin = std::numeric_limits<double>::infinity();
}

void AlwaysJudge::observe(const Tick& tick) {
  if (!tick.in_window) return;
  const bool undefined = std::isnan(tick.value);
  const double margin = grading::margin(condition_, tick.value);
  ++so_far_.ticks;
  if (undefined) ++so_far_.undefined;
  so_far_.margin = std::min(so_far_.margin, wanted_ || undefined ? margin : -margin);
  if (!undefined && holds(condition_, tick.value) == wanted_) return;
  if (!so_far_.first_violation) so_far_.first_violation = tick.at;
}

Verdict AlwaysJudge::verdict() const {
  Verdict verdict = so_far_;
  if (so_far_.first_violation)
    verdict.reason = "violated at " + at_text(*so_far_.first_violation);
  else if (so_far_.ticks == 0)
    verdict.reason = kNoTick;
  return verdict;
}

ExpectationState AlwaysJudge::state() const {
  if (so_far_.first_violation) return ExpectationState::kFailed;
  return so_far_.ticks > 0 ? ExpectationState::kHolds : ExpectationState::kOpen;
}

}  // namespace pitwall::grading
