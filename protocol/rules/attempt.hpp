// Attempt of one car to pass the other: from green to its ending.
//   in     the state before, rules, the round speed, what is true of both cars now
//   out    the next state; its ending, once there is one, stays
//   phases kClosingUp  green: the attacker closes up and trails, on any lane
//          kPassing    waving green: two laps of the attacker to a gap of 30 m ahead
//          kClosingTheDoor  the pass is complete; the attacker has to take the inside lane
//          kEnded
//   order  of endings that become true at once: contact, stopped, declined, the attacker's breach,
//          the defender's breach, the limit of laps
//   invariants
//          phases only follow in this order; waving green that is taken back does not give the laps
//          back; a copy of the state is a snapshot
//   errors a lead or a distance that is NaN stops the attempt (kStopped): nobody can judge it
//   cost   O(1), no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/rules/passing_rules.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::rules {

enum class Phase : std::uint8_t { kClosingUp, kPassing, kClosingTheDoor, kEnded };

enum class Ending : std::uint8_t {
  kPassed,
  kOutOfLaps,         // no gap of 30 m within two laps
  kNotClosedUp,       // never trailed a defender that kept to its rule
  kDeclined,          // by the attacker
  kEarly,             // drew level without waving green
  kCutIn,             // took the inside lane beside the defender or with less than 30 m
  kDoorOpen,          // did not take the inside lane after the pass
  kDefenderLeftLane,  // the defender left the inside lane
  kDefenderSpeed,     // the defender did not hold the round speed
  kStopped,           // by race control, or nobody could judge it
  kContactByAttacker,
  kContactByDefender,
  kContactShared,  // caused by both or by neither
};

enum class ContactCause : std::uint8_t { kAttacker, kDefender, kShared };

// What is true now.
struct AttemptView {
  bool pass_allowed = false;
  double lead_m = kUnset;                // not wrapped: a lap is a lap
  double length_m = kUnset;              // mean of the two cars
  double attacker_travelled_m = kUnset;  // along the track, not wrapped
  double defender_mps = kUnset;
  bool attacker_inside = false, defender_inside = false;  // lane: the half of the track
  std::optional<ContactCause> contact{};
  bool declined = false, stopped = false;
};

struct AttemptState {
  Phase phase = Phase::kClosingUp;
  std::optional<Ending> ending{};
  double green_at_m = kUnset, waving_at_m = kUnset, clear_at_m = kUnset;  // attacker_travelled_m
  double most_lead_m = kUnset;
};

AttemptState step(const PassingRules& rules, double round_speed_mps, double track_length_m,
                  const AttemptState& state, const AttemptView& now);

// Laps of the attacker since waving green; 0 before.
double laps_used(const AttemptState& state, double track_length_m, double attacker_travelled_m);

const char* name_of(Ending ending);    // "passed", "out_of_laps" ...
const char* reason_of(Ending ending);  // a sentence
std::optional<Ending> ending_named(const char* name);

}  // namespace pitwall::rules
