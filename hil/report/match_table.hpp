// Match sheet of a report: one row for each attempt of a passing competition, and the result.
//   in     the member `match` of a result file (race::to_json(MatchSheet))
//   out    MatchRows; HTML, all text escaped
//   errors a result without a match has none; a missing number is shown as a dash
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocol/json/json_value.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::report {

struct AttemptRow {
  std::string attacker, defender, ending, score, reason;
  double round_speed_mph = kUnset, repeat = kUnset;
  double green_s = kUnset, waving_s = kUnset, clear_s = kUnset, ended_s = kUnset;
  double laps_used = kUnset, most_lead_m = kUnset;
  double defender_least_mps = kUnset, defender_most_mps = kUnset;
};

struct MatchRows {
  std::vector<AttemptRow> attempts;
  std::string result;
};

std::optional<MatchRows> match_of(const json::JsonValue& result);

std::string match_table(const MatchRows& match);

}  // namespace pitwall::report
