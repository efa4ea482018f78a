// Time trial: two runs of each car alone; the mean of the fastest laps of both decides.
//   in     mean speeds of the flying laps of each run
//   out    score of a car, order of two cars, who goes on after a draw
//   units  m/s
//   invariants
//          a slower lap never changes a score; the order of the laps of a run does not matter;
//          better(a, b) and better(b, a) are never both true
//   errors a speed that is not finite and positive is no lap
//   source Saba et al.: "mean of the fastest lap of two runs"; a tie goes to the top seed
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "protocol/rules/match.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::rules {

inline constexpr std::size_t kTrialRuns = 2;

struct TimeTrial {
  std::array<double, kTrialRuns> fastest_mps{kUnset, kUnset};

  bool operator==(const TimeTrial&) const = default;
};

// `run` is below kTrialRuns.
TimeTrial with_lap(const TimeTrial& trial, std::size_t run, double mean_mps);

// None without a lap in both runs.
std::optional<double> score_mps(const TimeTrial& trial);

// A car without a score is better than no other.
bool better(const TimeTrial& a, const TimeTrial& b);

// The car that goes on: the winner, or after a draw the one with the better time trial. None for an
// open match, and for a draw of two that are equal.
std::optional<std::uint8_t> advancing(const Match& match,
                                      const std::array<TimeTrial, kCars>& trials);

}  // namespace pitwall::rules
