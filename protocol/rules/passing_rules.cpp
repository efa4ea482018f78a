// SPDX-License-Identifier: Apache-2.0
#include "protocol/rules/passing_rules.hpp"

#include "protocol/vocabulary/check.hpp"

namespace pitwall::rules {

RoundSpeeds standard_rounds_mph() {
  RoundSpeeds rounds;
  for (const double speed_mph : kRoundSpeeds_mph) CHECK(rounds.push(speed_mph));
  return rounds;
}

bool is_behind(const Situation& now) { return gap_behind_m(now) >= 0.0; }

bool is_clear(const PassingRules& rules, const Situation& now) {
  return gap_ahead_m(now) >= rules.clear_gap_m;
}

// Written so that NaN is a breach.
bool holds_speed(const PassingRules& rules, double round_speed_mps, double speed_mps) {
  return speed_mps - round_speed_mps <= rules.defender_over_mps &&
         round_speed_mps - speed_mps <= rules.defender_under_mps;
}

bool keeps_rule(const PassingRules& rules, double round_speed_mps, double speed_mps, bool inside) {
  return inside && holds_speed(rules, round_speed_mps, speed_mps);
}

Rights rights_of(const PassingRules& rules, const Situation& now) {
  const bool clear = now.pass_allowed && is_clear(rules, now);
  if (now.role == Role::kDefender)
    return {.may_draw_level = true,
            .may_take_inside = true,
            .must_take_inside = !clear,
            .holds_round_speed = true,
            .has_right_of_way = !clear};
  return {.may_draw_level = now.pass_allowed,
          .may_take_inside = clear || is_behind(now),
          .must_take_inside = clear,
          .holds_round_speed = false,
          .has_right_of_way = clear};
}

}  // namespace pitwall::rules
