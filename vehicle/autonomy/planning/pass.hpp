// Pass: what our car does about its rival, as a machine of few states that it does not leave by
// noise.
//   in     the rival; what flags and role allow; the lines that lead past it, as PassWay
//   out    PassState: what it does, on which line; and PassDemand: the speed for it
//   states
//          free   no car ahead that matters        -> trail
//          trail  at a fixed gap behind the rival  -> pass, free
//          pass   on a line beside it, faster      -> ahead, yield
//          ahead  passed; back to the own line     -> free, yield
//          yield  gives way and falls behind       -> trail, free
//   invariants
//          no other transitions; each state lasts dwell_s at least, but for yield
//          ahead and behind change by side_gap_m to either side of zero, never at zero
//          the speed of a pass is latched: it never falls while the pass lasts
//          a pass begins only where its own limited profile brings it past the rival before the
//          horizon; it is given up for a named risk while braking still keeps the
//          car behind, and for nothing else
//   source hysteresis and committed states: the paper's planner, which decided anew at every tick
//          who is ahead, lost its last pass by it (Saba et al., on the pass at 135 mph)
//   cost   O(1), no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/rules/fuel.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/planning/rival.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::planning {

// kPaper: the published planner's primitives, decided anew at every tick; for comparison.
enum class PassLaw : std::uint8_t { kCommitted, kPaper };

struct PassParams {
  PassLaw law = PassLaw::kCommitted;
  RivalParams rival;
  double trail_gap_m = kUnset;     // between the centres of the cars
  double complete_gap_m = kUnset;  // from which the door is closed; the rule's gap and a margin
  double side_gap_m = kUnset;      // of "ahead" and "behind"
  double side_clear_m = kUnset;    // lateral distance of the centres, that a pass needs
  double trail_gain_per_s = kUnset;
  double close_extra_mps = kUnset;  // to close up
  double pass_extra_mps = kUnset;   // over the faster of round speed and rival
  double brake_mps2 = kUnset;       // with which a car ahead is met
  double merge_time_s = kUnset;
  double dwell_s = kUnset;
};

inline constexpr auto kPassRanges = std::to_array<world::NamedRange<PassParams>>({
    {"trail_gap_m", &PassParams::trail_gap_m, 10.0, 100.0},
    {"complete_gap_m", &PassParams::complete_gap_m, 15.0, 100.0},
    {"side_gap_m", &PassParams::side_gap_m, 1.0, 10.0},
    {"side_clear_m", &PassParams::side_clear_m, 2.5, 10.0},
    {"trail_gain_per_s", &PassParams::trail_gain_per_s, 0.05, 1.0},
    {"close_extra_mps", &PassParams::close_extra_mps, 0.5, 15.0},
    {"pass_extra_mps", &PassParams::pass_extra_mps, 1.0, 20.0},
    {"brake_mps2", &PassParams::brake_mps2, 1.0, 10.0},
    {"merge_time_s", &PassParams::merge_time_s, 1.0, 10.0},
    {"dwell_s", &PassParams::dwell_s, 0.0, 5.0},
});
inline constexpr auto kRivalRanges = std::to_array<world::NamedRange<RivalParams>>({
    {"watch_ahead_m", &RivalParams::watch_ahead_m, 30.0, 300.0},
    {"watch_behind_m", &RivalParams::watch_behind_m, 30.0, 300.0},
    {"forget_s", &RivalParams::forget_s, 0.5, 10.0},
});

enum class PassPhase : std::uint8_t { kFree, kTrail, kPass, kAhead, kYield };

// Why a pass was given up, or why none begins.
enum class PassBar : std::uint8_t {
  kNone,
  kNotAllowed,   // by flag or role
  kNoLine,       // no line is far enough from the rival
  kTooSlow,      // the own profile does not bring the car past before the horizon
  kNotSeen,      // the rival has not been measured for too long
  kRivalCloses,  // it moves into the line of the pass
};

// Of the attempt that our car has to make. kCommitted: it has been given waving green.
enum class AttemptChoice : std::uint8_t { kOpen, kCommitted, kDeclined };

// For an attacker on a green track. Fuel that nobody knows bars nothing.
AttemptChoice choose_attempt(AttemptChoice before, rules::FuelState fuel, bool attacks,
                             bool waving);

struct PassState {
  PassPhase phase = PassPhase::kFree;
  PassBar bar = PassBar::kNone;
  Instant since{};
  AttemptChoice attempt = AttemptChoice::kOpen;  // advance() keeps it
  Rival rival;
  std::size_t line = 0;      // in use; 0 is the own one
  double pass_mps = kUnset;  // latched
  bool passed = false;       // since the right to pass was given
  bool ahead = false;        // of the rival, with hysteresis
  Instant risk_since{};      // of the present risk; zero: none
};

// A line as a way past the rival.
struct PassWay {
  double beside_m = 0.0;     // least lateral distance to the rival along the pass
  double gained_m = kUnset;  // greatest gap that the own limited profile reaches on it
};

struct PassInputs {
  const Rival& rival;
  double base_mps = kUnset;            // demanded by flags and operator
  double most_mps = kUnset;            // that the operator allows
  bool may_pass = false;               // waving green, for the attacker
  bool may_close = false;              // green of some kind, for the attacker: closes up and trails
  std::span<const PassWay> ways = {};  // by line
  double line_n_m = kUnset;            // of the line in use, beside the rival
  double speed_mps = kUnset;           // of our car
  bool has_merged = true;              // the change of line is over
};

PassState advance(const PassParams& params, const PassState& state, const PassInputs& in,
                  Instant now);

// Speed of the phase; of a car ahead in the way see follow_mps().
double pass_speed_mps(const PassParams& params, const PassState& state, const PassInputs& in);

// Between the centres, to a car in the way.
inline constexpr double kLeastGap_m = 12.0;

// Speed behind a car that is in the way, ahead_m in front of ours.
double follow_mps(const PassParams& params, double brake_mps2, double ahead_m, double car_mps,
                  bool trails);

}  // namespace pitwall::planning
