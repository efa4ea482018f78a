// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/following.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::safety {
namespace {

// From where it is now, whatever that is.
void begin(FollowState& state, double reported, const world::Received<double>& received,
           Instant now) {
  const double other =
      received.received && std::isfinite(received.value) ? received.value : reported;
  state = {std::min(reported, other), std::max(reported, other), now, now};
}

void advance(const FollowLimits& limits, FollowState& state, double reported, double dt_s) {
  const double gone = -std::expm1(-dt_s / limits.settle_s);
  state.low = std::min(reported, state.low + gone * (reported - state.low));
  state.high = std::max(reported, state.high + gone * (reported - state.high));
}

}  // namespace

double excess_deviation(const FollowLimits& limits, FollowState& state, double reported,
                        const world::Received<double>& received, Instant now) {
  const Duration dt = now - state.at;
  if (!std::isfinite(state.low) || dt > kFollowPause || !std::isfinite(reported)) {
    begin(state, reported, received, now);
    return 0.0;
  }
  advance(limits, state, reported, dt.seconds());
  state.at = now;
  const double margin =
      limits.tolerance + limits.share * std::max(std::abs(state.low), std::abs(state.high));
  const double excess =
      std::max(state.low - margin - received.value, received.value - state.high - margin);
  const bool inside = excess <= 0.0;  // not a number is not
  if (inside || !received.fresh(now, kFeedbackAgeMax)) state.within = now;
  if (now - state.within < limits.persist) return 0.0;
  return std::isfinite(excess) ? excess : limits.tolerance;
}

}  // namespace pitwall::safety
