// SPDX-License-Identifier: Apache-2.0
#include "hil/report/match_table.hpp"

#include <array>
#include <cmath>

#include "hil/report/text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::report {
namespace {

constexpr std::array kHeads{"#",        "round, mph",   "attacks",       "defends",
                            "green, s", "waving, s",    "30 m ahead, s", "end, s",
                            "laps",     "most lead, m", "defender, m/s", "ending",
                            "score",    "why"};

AttemptRow attempt_of(const json::JsonValue& json) {
  return {.attacker = json.text("attacker"),
          .defender = json.text("defender"),
          .ending = json.text("ending"),
          .score = json.text("score"),
          .reason = json.text("reason"),
          .round_speed_mph = json.number("round_speed_mph"),
          .repeat = json.number("repeat"),
          .green_s = json.number("green_s"),
          .waving_s = json.number("waving_s"),
          .clear_s = json.number("clear_s"),
          .ended_s = json.number("ended_s"),
          .laps_used = json.number("laps_used"),
          .most_lead_m = json.number("most_lead_m"),
          .defender_least_mps = json.number("defender_least_mps"),
          .defender_most_mps = json.number("defender_most_mps")};
}

std::string figure(double value, int decimals) {
  return "<td>" + (std::isfinite(value) ? number(value, decimals) : "&ndash;") + "</td>";
}

std::string word(const std::string& text) {
  return "<td class=\"word\">" + escaped(text) + "</td>";
}

std::string speeds(const AttemptRow& row) {
  if (!std::isfinite(row.defender_least_mps)) return figure(kUnset, 1);
  return "<td>" + number(row.defender_least_mps, 1) + " to " + number(row.defender_most_mps, 1) +
         "</td>";
}

std::string row_of(const AttemptRow& row, std::size_t i) {
  std::string ending = row.ending;
  if (row.repeat > 0.0) ending += " (repeated attempt)";
  return formatted("<tr><td>%zu</td>", i + 1) + figure(row.round_speed_mph, 0) +
         word(row.attacker) + word(row.defender) + figure(row.green_s, 1) +
         figure(row.waving_s, 1) + figure(row.clear_s, 1) + figure(row.ended_s, 1) +
         figure(row.laps_used, 2) + figure(row.most_lead_m, 1) + speeds(row) + word(ending) +
         "<td>" + escaped(row.score) + "</td>" + word(row.reason) + "</tr>\n";
}

}  // namespace

std::optional<MatchRows> match_of(const json::JsonValue& result) {
  const json::JsonValue* match = result.find("match");
  if (match == nullptr || !match->is_object()) return std::nullopt;
  MatchRows rows{.attempts = {}, .result = match->text("result")};
  for (const json::JsonValue& attempt : match->items("attempts"))
    rows.attempts.push_back(attempt_of(attempt));
  return rows;
}

std::string match_table(const MatchRows& match) {
  std::string out = "<p id=\"match\"><strong>Result: " + escaped(match.result) + "</strong></p>\n";
  if (match.attempts.empty()) return out + "<p class=\"note\">No attempt has ended.</p>\n";
  out += "<table class=\"attempts\"><thead><tr>";
  for (const char* head : kHeads) out += std::string{"<th>"} + head + "</th>";
  out += "</tr></thead><tbody>";
  for (std::size_t i = 0; i < match.attempts.size(); ++i) out += row_of(match.attempts[i], i);
  return out + "</tbody></table>\n";
}

}  // namespace pitwall::report
