// SPDX-License-Identifier: Apache-2.0
#include "protocol/rules/match.hpp"

#include <array>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::rules {
namespace {

std::uint8_t other(std::uint8_t car) { return car == 0 ? 1 : 0; }

Match won(Match match, std::uint8_t winner) {
  match.result = Result::kWon;
  match.winner = winner;
  return match;
}

Match drawn(Match match) {
  match.result = Result::kDraw;
  return match;
}

Match after_contact(const Match& match, Ending ending) {
  if (ending == Ending::kContactByAttacker) return won(match, other(match.attacker));
  if (ending == Ending::kContactByDefender) return won(match, match.attacker);
  return drawn(match);
}

// Of the second attempt of a round.
Match after_round(const PassingRules& rules, Match match, bool second_passed) {
  if (match.first_passed != second_passed)
    return won(match, second_passed ? match.attacker : other(match.attacker));
  if (!second_passed || match.round + 1U == rules.round_speeds_mph.size()) return drawn(match);
  ++match.round;
  match.attacker = other(match.attacker);
  match.second = match.first_passed = false;
  return match;
}

}  // namespace

Match begin_match(std::uint8_t first_attacker) {
  CHECK(first_attacker < kCars);
  return {.attacker = first_attacker};
}

std::optional<Assignment> due(const PassingRules& rules, const Match& match) {
  if (match.result != Result::kOpen) return std::nullopt;
  return Assignment{.attacker = match.attacker,
                    .defender = other(match.attacker),
                    .round_speed_mph = rules.round_speeds_mph[match.round],
                    .round = match.round,
                    .repeats = match.repeats};
}

Score score_of(const PassingRules& rules, Ending ending, std::uint8_t repeats) {
  const bool repeatable = repeats < rules.repeats;
  switch (ending) {
    case Ending::kPassed:
      return Score::kPassed;
    case Ending::kDefenderLeftLane:
    case Ending::kDefenderSpeed:
      return repeatable ? Score::kRepeated : Score::kPassed;
    case Ending::kStopped:
      return repeatable ? Score::kRepeated : Score::kFailed;
    case Ending::kContactByAttacker:
    case Ending::kContactByDefender:
    case Ending::kContactShared:
      return Score::kMatchOver;
    case Ending::kOutOfLaps:
    case Ending::kNotClosedUp:
    case Ending::kDeclined:
    case Ending::kEarly:
    case Ending::kCutIn:
    case Ending::kDoorOpen:
      break;
  }
  return Score::kFailed;
}

Match record(const PassingRules& rules, const Match& match, Ending ending) {
  CHECK(match.result == Result::kOpen);
  CHECK(rules.repeats <= kRepeatsMax);
  const Score score = score_of(rules, ending, match.repeats);
  Match next = match;
  if (score == Score::kMatchOver) return after_contact(match, ending);
  if (score == Score::kRepeated) {
    ++next.repeats;
    return next;
  }
  next.repeats = 0;
  const bool passed = score == Score::kPassed;
  if (match.second) return after_round(rules, next, passed);
  next.first_passed = passed;
  next.second = true;
  next.attacker = other(match.attacker);
  return next;
}

const char* name_of(Score score) {
  constexpr std::array kNames{"passed", "failed", "repeated", "match over"};
  return kNames[static_cast<std::size_t>(score)];
}

}  // namespace pitwall::rules
