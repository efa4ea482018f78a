// SPDX-License-Identifier: Apache-2.0
#include "protocol/rules/attempt.hpp"

#include <array>
#include <cmath>
#include <cstring>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::rules {
namespace {

struct EndingText {
  Ending ending;
  const char* name;
  const char* reason;
};

constexpr std::array kEndings{
    EndingText{Ending::kPassed, "passed", "the attacker was 30 m ahead and closed the door"},
    EndingText{Ending::kOutOfLaps, "out_of_laps", "no gap of 30 m within two laps"},
    EndingText{Ending::kNotClosedUp, "not_closed_up", "the attacker did not close up under green"},
    EndingText{Ending::kDeclined, "declined", "the attacker declined"},
    EndingText{Ending::kEarly, "early", "the attacker drew level before waving green"},
    EndingText{Ending::kCutIn, "cut_in",
               "the attacker took the inside lane with less than 30 m to the defender"},
    EndingText{Ending::kDoorOpen, "door_open",
               "the attacker did not close the door after the pass"},
    EndingText{Ending::kDefenderLeftLane, "defender_left_lane",
               "the defender left the inside lane"},
    EndingText{Ending::kDefenderSpeed, "defender_speed",
               "the defender did not hold the round speed"},
    EndingText{Ending::kStopped, "stopped", "race control stopped the attempt"},
    EndingText{Ending::kContactByAttacker, "contact_by_attacker",
               "a contact that the attacker caused"},
    EndingText{Ending::kContactByDefender, "contact_by_defender",
               "a contact that the defender caused"},
    EndingText{Ending::kContactShared, "contact_shared",
               "a contact that both cars or neither caused"},
};

Ending ending_of(ContactCause cause) {
  switch (cause) {
    case ContactCause::kAttacker:
      return Ending::kContactByAttacker;
    case ContactCause::kDefender:
      return Ending::kContactByDefender;
    case ContactCause::kShared:
      break;
  }
  return Ending::kContactShared;
}

// The attacker after waving green.
Situation waved(const AttemptView& now) {
  return {.role = Role::kAttacker,
          .pass_allowed = true,
          .lead_m = now.lead_m,
          .length_m = now.length_m};
}

std::optional<Ending> stopped_by(const AttemptView& now) {
  if (now.contact) return ending_of(*now.contact);
  if (now.stopped || !std::isfinite(now.lead_m + now.length_m + now.attacker_travelled_m))
    return Ending::kStopped;
  if (now.declined) return Ending::kDeclined;
  return std::nullopt;
}

// A lap that is not used up: of those since a place where the attacker was.
bool has_used(double laps, double track_length_m, double since_m, double at_m) {
  return at_m - since_m > laps * track_length_m;
}

std::optional<Ending> breach_of_defender(const PassingRules& rules, double round_speed_mps,
                                         const AttemptView& now) {
  if (!now.defender_inside) return Ending::kDefenderLeftLane;
  if (!holds_speed(rules, round_speed_mps, now.defender_mps)) return Ending::kDefenderSpeed;
  return std::nullopt;
}

std::optional<Ending> breach(const PassingRules& rules, double round_speed_mps, Phase phase,
                             const AttemptView& now) {
  Situation attacker = waved(now);
  attacker.pass_allowed = phase != Phase::kClosingUp;
  const Rights rights = rights_of(rules, attacker);
  if (!rights.may_draw_level && !is_behind(attacker)) return Ending::kEarly;
  if (!rights.may_take_inside && now.attacker_inside) return Ending::kCutIn;
  if (phase != Phase::kPassing || rights.has_right_of_way) return std::nullopt;
  return breach_of_defender(rules, round_speed_mps, now);
}

std::optional<Ending> out_of_laps(const PassingRules& rules, double round_speed_mps,
                                  double track_length_m, const AttemptState& state,
                                  const AttemptView& now) {
  const double at_m = now.attacker_travelled_m;
  switch (state.phase) {
    case Phase::kClosingUp:
      if (has_used(rules.close_up_laps, track_length_m, state.green_at_m, at_m))
        return breach_of_defender(rules, round_speed_mps, now).value_or(Ending::kNotClosedUp);
      break;
    case Phase::kPassing:
      if (has_used(rules.laps, track_length_m, state.waving_at_m, at_m)) return Ending::kOutOfLaps;
      break;
    case Phase::kClosingTheDoor:
      if (has_used(rules.door_laps, track_length_m, state.clear_at_m, at_m))
        return Ending::kDoorOpen;
      break;
    case Phase::kEnded:
      break;
  }
  return std::nullopt;
}

void advance(const PassingRules& rules, const AttemptView& now, AttemptState& state) {
  if (state.phase == Phase::kClosingUp && now.pass_allowed) {
    state.phase = Phase::kPassing;
    state.waving_at_m = now.attacker_travelled_m;
  }
  if (state.phase == Phase::kPassing && is_clear(rules, waved(now))) {
    state.phase = Phase::kClosingTheDoor;
    state.clear_at_m = now.attacker_travelled_m;
  }
}

AttemptState ended(AttemptState state, Ending ending) {
  state.phase = Phase::kEnded;
  state.ending = ending;
  return state;
}

}  // namespace

AttemptState step(const PassingRules& rules, double round_speed_mps, double track_length_m,
                  const AttemptState& state, const AttemptView& now) {
  AttemptState next = state;
  if (next.phase == Phase::kEnded) return next;
  if (const auto ending = stopped_by(now)) return ended(next, *ending);
  if (std::isnan(next.green_at_m)) next.green_at_m = now.attacker_travelled_m;
  next.most_lead_m = std::fmax(next.most_lead_m, now.lead_m);
  if (const auto ending = out_of_laps(rules, round_speed_mps, track_length_m, next, now))
    return ended(next, *ending);
  advance(rules, now, next);
  if (const auto ending = breach(rules, round_speed_mps, next.phase, now))
    return ended(next, *ending);
  if (next.phase == Phase::kClosingTheDoor && now.attacker_inside && is_clear(rules, waved(now)))
    return ended(next, Ending::kPassed);
  return next;
}

double laps_used(const AttemptState& state, double track_length_m, double attacker_travelled_m) {
  if (std::isnan(state.waving_at_m)) return 0.0;
  return (attacker_travelled_m - state.waving_at_m) / track_length_m;
}

const char* name_of(Ending ending) { return kEndings[static_cast<std::size_t>(ending)].name; }
const char* reason_of(Ending ending) { return kEndings[static_cast<std::size_t>(ending)].reason; }

std::optional<Ending> ending_named(const char* name) {
  for (const EndingText& row : kEndings)
    if (std::strcmp(row.name, name) == 0) return row.ending;
  return std::nullopt;
}

}  // namespace pitwall::rules
