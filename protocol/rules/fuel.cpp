// SPDX-License-Identifier: Apache-2.0
#include "protocol/rules/fuel.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::rules {
namespace {

constexpr double kFilled_l = 2.0;  // a level that rises by less sloshes

}  // namespace

void FuelEstimator::enter(double litres, double used_l) {
  if (!std::isfinite(litres)) return;
  entered_l_ = litres;
  used_when_entered_l_ = use_.used_l() - (std::isfinite(used_l) ? used_l : 0.0);
}

void FuelEstimator::receive_engine(const EngineSample& sample, Instant sampled, double lap) {
  use_.receive(sample, sampled);
  if (!is_measured_) follow_laps(use_.used_l(), lap);
}

void FuelEstimator::receive_tank(double level_l, double used_l, double lap) {
  if (!std::isfinite(level_l)) return;
  const bool by_used = std::isfinite(used_l);
  const bool begins_anew = !is_measured_ || level_l > tank_l_ + kFilled_l || by_used != by_used_;
  is_measured_ = true;
  tank_l_ = level_l;
  by_used_ = by_used;
  if (begins_anew) lap_ = kUnset;
  follow_laps(by_used ? used_l : -level_l, lap);
}

void FuelEstimator::follow_laps(double burnt_l, double lap) {
  if (!std::isfinite(lap) || lap == lap_) return;
  const bool next = lap == lap_ + 1.0;
  if (next && whole_lap_ && burnt_l > burnt_at_lap_l_)
    burnt_l_[laps_++ % kLaps] = burnt_l - burnt_at_lap_l_;
  whole_lap_ = next;  // it began where the lap began
  lap_ = lap;
  burnt_at_lap_l_ = burnt_l;
}

double FuelEstimator::level_l() const {
  if (is_measured_ || std::isnan(entered_l_)) return tank_l_;
  return std::max(0.0, entered_l_ - since_entered_l());
}

FuelLeft FuelEstimator::left(const FuelPlan& plan) const {
  FuelLeft left{.level_l = level_l(), .measured = laps_ > 0};
  const auto known = static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(laps_, kLaps));
  left.per_lap_l = left.measured ? *std::max_element(burnt_l_.begin(), burnt_l_.begin() + known)
                                 : plan.guess_l_per_lap;
  if (!std::isfinite(left.level_l)) return left;
  left.estimated = !is_measured_;
  left.least_l = left.level_l;
  double most_per_lap_l = left.per_lap_l;
  if (left.estimated) {
    left.least_l = std::max(0.0, left.level_l - plan.spread * since_entered_l());
    most_per_lap_l = std::max(left.per_lap_l, plan.guess_l_per_lap) * (1.0 + plan.spread);
  }
  left.laps = std::max(0.0, left.level_l - plan.reserve_l) / left.per_lap_l;
  left.least_laps = std::max(0.0, left.least_l - plan.reserve_l) / most_per_lap_l;
  left.attempts = std::max(0.0, std::floor((left.least_laps - plan.home_laps) / plan.attempt_laps));
  left.state = left.least_laps < plan.home_laps ? FuelState::kHomeNow
               : left.attempts < 1.0            ? FuelState::kNoAttempt
                                                : FuelState::kEnough;
  return left;
}

}  // namespace pitwall::rules
