// Match sheet: attempt by attempt, what was tried, how it ended and why, and who has won.
//   in     the judge's records, the names of the two cars
//   out    MatchSheet; one JSON object; one line of text for each attempt
//   units  in the names
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "hil/nodes/judge.hpp"
#include "protocol/rules/match.hpp"

namespace pitwall::race {

struct MatchSheet {
  std::array<std::string, rules::kCars> names;
  std::vector<AttemptRecord> attempts;
  rules::Match match;
};

MatchSheet sheet_of(const JudgeState& state, const std::array<std::string, rules::kCars>& names);

// "own", the name of a car; "draw", "open".
std::string result_text(const MatchSheet& sheet);
// Attempt `i` in one sentence.
std::string to_text(const MatchSheet& sheet, std::size_t i);
std::string to_json(const MatchSheet& sheet);

}  // namespace pitwall::race
