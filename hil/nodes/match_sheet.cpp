// SPDX-License-Identifier: Apache-2.0
#include "hil/nodes/match_sheet.hpp"

#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::race {
namespace {

// NaN, which JSON has as null, for what was not reached.
double seconds_of(Instant at) { return at == Instant{} ? kUnset : at.seconds(); }

const std::string& attacker_of(const MatchSheet& sheet, const AttemptRecord& attempt) {
  return sheet.names[attempt.assignment.attacker];
}

std::string attempt_json(const MatchSheet& sheet, const AttemptRecord& attempt) {
  return json::Object{}
      .number("round", attempt.assignment.round + 1)
      .number("round_speed_mph", attempt.assignment.round_speed_mph)
      .number("repeat", attempt.assignment.repeats)
      .text("attacker", attacker_of(sheet, attempt))
      .text("defender", sheet.names[attempt.assignment.defender])
      .text("ending", rules::name_of(attempt.ending))
      .text("reason", rules::reason_of(attempt.ending))
      .text("score", rules::name_of(attempt.score))
      .number("formed_s", attempt.formed.seconds())
      .number("green_s", seconds_of(attempt.green))
      .number("waving_s", seconds_of(attempt.waving))
      .number("clear_s", seconds_of(attempt.clear))
      .number("ended_s", attempt.ended.seconds())
      .number("laps_used", attempt.laps_used)
      .number("most_lead_m", attempt.most_lead_m)
      .number("defender_least_mps", attempt.defender_least_mps)
      .number("defender_most_mps", attempt.defender_most_mps)
      .str();
}

}  // namespace

MatchSheet sheet_of(const JudgeState& state, const std::array<std::string, rules::kCars>& names) {
  return {.names = names,
          .attempts = {state.attempts.begin(), state.attempts.end()},
          .match = state.match};
}

std::string result_text(const MatchSheet& sheet) {
  switch (sheet.match.result) {
    case rules::Result::kOpen:
      return "open";
    case rules::Result::kDraw:
      return "draw";
    case rules::Result::kWon:
      break;
  }
  return sheet.names[sheet.match.winner];
}

std::string to_text(const MatchSheet& sheet, std::size_t i) {
  const AttemptRecord& attempt = sheet.attempts[i];
  return formatted("attempt %zu, %.0f mph, %s attacks, %.2f laps: %s (%s): %s", i + 1,
                   attempt.assignment.round_speed_mph, attacker_of(sheet, attempt).c_str(),
                   attempt.laps_used, rules::name_of(attempt.ending), rules::name_of(attempt.score),
                   rules::reason_of(attempt.ending));
}

std::string to_json(const MatchSheet& sheet) {
  json::Array attempts;
  for (const AttemptRecord& attempt : sheet.attempts) attempts.json(attempt_json(sheet, attempt));
  json::Array cars;
  for (const std::string& name : sheet.names) cars.text(name);
  return json::Object{}
      .json("cars", cars.str())
      .json("attempts", attempts.str())
      .text("result", result_text(sheet))
      .str();
}

}  // namespace pitwall::race
