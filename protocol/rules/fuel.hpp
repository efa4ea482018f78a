// Estimator of the fuel in a car, in litres, laps and attempts of the passing competition: the same
// one in car and base. An attempt takes two laps and the lap into the pits; a team that began one
// with fuel for a single lap lost its place.
//   in     litres in the tank as an operator entered them; the engine's samples; the lap number; of
//          a car that measures its tank: level and litres used; the plan of the race
//   out    FuelLeft: what is expected to be left, and the least of it
//   invariants
//          a level that was measured counts, otherwise the entered one less what the engine must
//          have burnt, never anything else
//          the least is what is left if the car has burnt, and will burn, plan.spread more than
//          estimated, and not less in a lap than plan.guess_l_per_lap; a measured level has no
//          spread, and its laps no guess
//          only a whole lap is measured: from one change of the lap number to the next, with fuel
//          burnt in it. The consumption is the largest of the last kLaps laps; before the first one
//          it is the guess of the plan
//          attempts and state follow from the least, not from what is expected
//          refuelling starts a new measurement; the laps measured before stay
//   errors a level that is not a number changes nothing
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "protocol/rules/fuel_use.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::rules {

struct FuelPlan {
  double attempt_laps = 2.0;     // of the passing competition
  double home_laps = 1.0;        // the lap into the pits
  double reserve_l = 2.0;        // that the pump does not reach
  double guess_l_per_lap = 2.2;  // of a lap at the speed of a pass, as the operator has it
  double spread = 0.13;          // by which the consumption may be above the estimate
};

enum class FuelState : std::uint8_t { kUnknown, kEnough, kNoAttempt, kHomeNow };

struct FuelLeft {
  double level_l = kUnset, per_lap_l = kUnset, laps = kUnset;  // expected
  double least_l = kUnset, least_laps = kUnset;
  double attempts = kUnset;  // whole ones, of the least
  FuelState state = FuelState::kUnknown;
  bool measured = false;   // the consumption; false: it is the guess of the plan
  bool estimated = false;  // the level is estimated, not measured
};

class FuelEstimator {
 public:
  static constexpr std::size_t kLaps = 3;

  // By an operator. `used_l`: of them already used, as estimated, where the entry is of before.
  void enter(double litres, double used_l = 0.0);
  void receive_engine(const EngineSample& sample, Instant sampled, double lap);
  // `used_l`: since the start, if the car counts it; finer than the level.
  void receive_tank(double level_l, double used_l, double lap);
  FuelLeft left(const FuelPlan& plan) const;

 private:
  double since_entered_l() const { return use_.used_l() - used_when_entered_l_; }
  double level_l() const;
  void follow_laps(double burnt_l, double lap);

  FuelUse use_;
  double entered_l_ = kUnset, used_when_entered_l_ = 0.0;
  bool is_measured_ = false, by_used_ = false;  // the level; its use by a counter
  double tank_l_ = kUnset;
  double lap_ = kUnset, burnt_at_lap_l_ = kUnset;
  bool whole_lap_ = false;
  std::array<double, kLaps> burnt_l_{};
  std::uint64_t laps_ = 0;
};

}  // namespace pitwall::rules
