// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/fuel.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::state {
namespace {

constexpr double kFilled_l = 2.0;  // a level that rises by less sloshes

}  // namespace

void FuelEstimator::receive(double level_l, double used_l, double lap) {
  if (!std::isfinite(level_l)) return;
  const bool by_used = std::isfinite(used_l);
  const double burnt_l = by_used ? used_l : -level_l;
  const bool begins_anew = level_l > level_l_ + kFilled_l || by_used != by_used_;
  level_l_ = level_l;
  by_used_ = by_used;
  if (begins_anew) lap_ = kUnset;
  if (!std::isfinite(lap) || lap == lap_) return;
  const bool next = lap == lap_ + 1.0;
  if (next && whole_lap_ && burnt_l > burnt_at_lap_l_) {
    burnt_l_[laps_++ % kLaps] = burnt_l - burnt_at_lap_l_;
  }
  whole_lap_ = next;  // it began where the lap began
  lap_ = lap;
  burnt_at_lap_l_ = burnt_l;
}

FuelLeft FuelEstimator::left(const FuelPlan& plan) const {
  FuelLeft left{.level_l = level_l_, .measured = laps_ > 0};
  const auto known = static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(laps_, kLaps));
  left.per_lap_l = left.measured ? *std::max_element(burnt_l_.begin(), burnt_l_.begin() + known)
                                 : plan.guess_l_per_lap;
  if (!std::isfinite(level_l_)) return left;
  left.laps = std::max(0.0, level_l_ - plan.reserve_l) / left.per_lap_l;
  left.attempts = std::max(0.0, std::floor((left.laps - plan.home_laps) / plan.attempt_laps));
  left.state = left.laps < plan.home_laps ? FuelState::kHomeNow
               : left.attempts < 1.0      ? FuelState::kNoAttempt
                                          : FuelState::kEnough;
  return left;
}

}  // namespace pitwall::state
