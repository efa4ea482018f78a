// Rules of the passing competition for two cars: roles, round speeds, limits, right of way.
//   in     role of a car, whether race control shows waving green, lead of the attacker
//   out    what the car may do and what it has to do
//   units  lead: of the attacker's centre before the defender's along the track [m], negative
//          behind; the gap is the free road between the two cars
//   invariants
//          at every lead exactly one of the two cars has the right of way to the inside lane
//   source Saba et al., roles and rules of the passing competition: round speeds, two laps, a pass
//          is complete at a gap of 30 m and then closes the door; green and waving green. The
//          values under "ours" are not public
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::rules {

inline constexpr std::size_t kCars = 2;
inline constexpr std::size_t kRoundsMax = 12;

enum class Role : std::uint8_t { kAttacker, kDefender };

inline constexpr std::array kRoundSpeeds_mph{80.0, 100.0, 115.0, 125.0, 135.0, 150.0};

using RoundSpeeds = FixedVector<double, kRoundsMax>;
RoundSpeeds standard_rounds_mph();

struct PassingRules {
  RoundSpeeds round_speeds_mph = standard_rounds_mph();  // rising; at least one
  double laps = 2.0;          // of the attacker, from waving green to a complete pass
  double clear_gap_m = 30.0;  // of a complete pass
  // Ours.
  double close_up_laps = 6.0;      // of the attacker, from green until it trails
  double door_laps = 1.0;          // of the attacker, from a complete pass to the inside lane
  double defender_over_mps = 2.0;  // fastest that the defender may be above the round speed
  double defender_under_mps = 4.0;
  std::uint8_t repeats = 1;  // of an attempt that does not count
};

struct Situation {
  Role role = Role::kDefender;
  bool pass_allowed = false;  // waving green
  double lead_m = kUnset;
  double length_m = kUnset;  // mean of the two cars
};

struct Rights {
  bool may_draw_level = false;   // get beside the other car or before it
  bool may_take_inside = false;  // be in the inside lane
  bool must_take_inside = false;
  bool holds_round_speed = false;
  bool has_right_of_way = false;  // the other car has to leave it the inside lane

  bool operator==(const Rights&) const = default;
};

// Free road between the attacker's nose and the defender's tail, or the other way round.
constexpr double gap_behind_m(const Situation& now) { return -now.lead_m - now.length_m; }
constexpr double gap_ahead_m(const Situation& now) { return now.lead_m - now.length_m; }

// NaN for the lead counts as level with the defender: nothing is permitted to the attacker.
bool is_behind(const Situation& now);
bool is_clear(const PassingRules& rules, const Situation& now);  // the pass is complete

// Whether a defender at this speed, in the inside lane or not, keeps to its rule. NaN: it does not.
bool keeps_rule(const PassingRules& rules, double round_speed_mps, double speed_mps, bool inside);
bool holds_speed(const PassingRules& rules, double round_speed_mps, double speed_mps);

Rights rights_of(const PassingRules& rules, const Situation& now);

}  // namespace pitwall::rules
