// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/following.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::safety {
namespace {

// From where it is now, whatever that is.
void begin(FollowState& state, double told, const world::Heard<double>& heard, Instant now) {
  const double other = heard.heard && std::isfinite(heard.value) ? heard.value : told;
  state = {std::min(told, other), std::max(told, other), now, now};
}

void advance(const FollowLimits& limits, FollowState& state, double told, double dt_s) {
  const double gone = -std::expm1(-dt_s / limits.settle_s);
  state.low = std::min(told, state.low + gone * (told - state.low));
  state.high = std::max(told, state.high + gone * (told - state.high));
}

}  // namespace

double straying(const FollowLimits& limits, FollowState& state, double told,
                const world::Heard<double>& heard, Instant now) {
  const Duration dt = now - state.at;
  if (!std::isfinite(state.low) || dt > kFollowPause || !std::isfinite(told)) {
    begin(state, told, heard, now);
    return 0.0;
  }
  advance(limits, state, told, dt.seconds());
  state.at = now;
  const double margin =
      limits.tolerance + limits.share * std::max(std::abs(state.low), std::abs(state.high));
  const double excess =
      std::max(state.low - margin - heard.value, heard.value - state.high - margin);
  const bool inside = excess <= 0.0;  // not a number is not
  if (inside || !heard.fresh(now, kFeedbackAgeMax)) state.within = now;
  if (now - state.within < limits.persist) return 0.0;
  return std::isfinite(excess) ? excess : limits.tolerance;
}

}  // namespace pitwall::safety
