// Fuel range in laps and attempts. The paper's team accepted an attempt of two laps with fuel for
// one, and lost its place.
//   in     litres in the tank, litres used and lap number as they come; the plan of the race
//   out    litres per lap, laps left, whole attempts that still leave fuel to come home
//   invariants
//          a lap counts when the car drove it whole, from one change of the lap number to the next,
//          with fuel burnt. Judged by the thirstiest of the last kLaps; by the plan's guess until
//          there is one
//          filling the tank begins anew, and forgets no lap
//   errors a level that is no number changes nothing
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
  bool measured = false;   // else by the plan's guess
  bool estimated = false;  // the level is reckoned, not measured
};

class FuelBook {
 public:
  static constexpr std::size_t kLaps = 3;

  // `used_l`: since the start, where the car counts it; finer than the level.
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
