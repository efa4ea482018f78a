// Fuel range in laps and in attempts of the passing competition. An attempt takes two laps and the
// lap into the pits; a team that began one with fuel for a single lap lost its place.
//   in     litres in the tank, litres used since the start, lap number; the plan of the race
//   out    litres per lap, laps left, whole attempts after which the car still reaches the pits
//   invariants
//          only a whole lap is measured: from one change of the lap number to the next, with fuel
//          burnt in it. The consumption is the largest of the last kLaps measured laps; before the
//          first one it is the guess of the plan
//          refuelling starts a new measurement; the laps measured before stay
//   errors a level that is not a number changes nothing
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::state {

struct FuelPlan {
  double attempt_laps = 2.0;     // of the passing competition
  double home_laps = 1.0;        // the lap into the pits
  double reserve_l = 2.0;        // that the pump does not reach
  double guess_l_per_lap = 2.2;  // of LVMS at speed, before a lap was measured
};

enum class FuelState : std::uint8_t { kUnknown, kEnough, kNoAttempt, kHomeNow };

struct FuelLeft {
  double level_l = kUnset, per_lap_l = kUnset, laps = kUnset, attempts = kUnset;
  FuelState state = FuelState::kUnknown;
  bool measured = false;   // the consumption; false: it is the guess of the plan
  bool estimated = false;  // the level is estimated, not measured
};

class FuelEstimator {
 public:
  static constexpr std::size_t kLaps = 3;

  // `used_l`: since the start, if the car counts it; finer than the level.
  void receive(double level_l, double used_l, double lap);
  FuelLeft left(const FuelPlan& plan) const;

 private:
  double level_l_ = kUnset;
  double lap_ = kUnset, burnt_at_lap_l_ = kUnset;
  bool whole_lap_ = false, by_used_ = false;
  std::array<double, kLaps> burnt_l_{};
  std::uint64_t laps_ = 0;
};

}  // namespace pitwall::state
