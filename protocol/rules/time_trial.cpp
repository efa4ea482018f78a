// SPDX-License-Identifier: Apache-2.0
#include "protocol/rules/time_trial.hpp"

#include <cmath>

namespace pitwall::rules {

TimeTrial with_lap(const TimeTrial& trial, std::size_t run, double mean_mps) {
  TimeTrial next = trial;
  double& fastest_mps = next.fastest_mps.at(run);
  if (std::isfinite(mean_mps) && mean_mps > 0.0) fastest_mps = std::fmax(fastest_mps, mean_mps);
  return next;
}

std::optional<double> score_mps(const TimeTrial& trial) {
  double sum_mps = 0.0;
  for (const double fastest_mps : trial.fastest_mps) sum_mps += fastest_mps;
  if (std::isnan(sum_mps)) return std::nullopt;
  return sum_mps / static_cast<double>(kTrialRuns);
}

bool better(const TimeTrial& a, const TimeTrial& b) {
  const auto of_a = score_mps(a), of_b = score_mps(b);
  return of_a && *of_a > of_b.value_or(0.0);
}

std::optional<std::uint8_t> advancing(const Match& match,
                                      const std::array<TimeTrial, kCars>& trials) {
  if (match.result == Result::kOpen) return std::nullopt;
  if (match.result == Result::kWon) return match.winner;
  if (better(trials[0], trials[1])) return std::uint8_t{0};
  if (better(trials[1], trials[0])) return std::uint8_t{1};
  return std::nullopt;
}

}  // namespace pitwall::rules
