// SPDX-License-Identifier: Apache-2.0
#include "hil/scenario/match_section.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "protocol/rules/match.hpp"

namespace pitwall::scenario {
namespace {

using traffic::Defence;
using traffic::Manner;

constexpr double kLaneReach_m = 30.0, kRoundLeast_mph = 10.0, kRoundMost_mph = 200.0;
constexpr double kLongestMatch_s = 36'000.0;

constexpr std::array kMannerWords{
    std::pair<std::string_view, Manner>{"pass", Manner::kPass},
    std::pair<std::string_view, Manner>{"follow", Manner::kFollow},
    std::pair<std::string_view, Manner>{"cut_in", Manner::kCutIn},
    std::pair<std::string_view, Manner>{"early", Manner::kEarly},
    std::pair<std::string_view, Manner>{"ram", Manner::kRam},
    std::pair<std::string_view, Manner>{"open_door", Manner::kOpenDoor},
    std::pair<std::string_view, Manner>{"decline", Manner::kDecline},
};

constexpr std::array kDefenceWords{
    std::pair<std::string_view, Defence>{"hold", Defence::kHold},
    std::pair<std::string_view, Defence>{"slow", Defence::kSlow},
    std::pair<std::string_view, Defence>{"wide", Defence::kWide},
};

template <class T, std::size_t N>
std::vector<T> words_of(yaml::StrictMap& map, const char* key,
                        const std::array<std::pair<std::string_view, T>, N>& table) {
  std::vector<T> out;
  if (!map.has(key)) return {table.front().second};
  for (const std::string& word : map.texts(key, 1, rules::kAttemptsMax)) {
    const auto row =
        std::ranges::find(table, std::string_view{word}, &std::pair<std::string_view, T>::first);
    if (row == table.end()) {
      std::string legal;
      for (const auto& [name, value] : table)
        legal += (legal.empty() ? "" : ", ") + std::string{name};
      map.fail(key, "\"" + word + "\" is not one of: " + legal);
    }
    out.push_back(row->second);
  }
  return out;
}

void read_brackets(yaml::StrictMap& map, rules::PassingRules& rules) {
  if (!map.has("brackets_mph")) return;
  rules.round_speeds_mph.clear();
  double last_mph = 0.0;
  for (const double speed_mph :
       map.numbers("brackets_mph", 1, rules::kRoundsMax, kRoundLeast_mph, kRoundMost_mph)) {
    if (speed_mph <= last_mph) map.fail("brackets_mph", "the round speeds must rise");
    last_mph = speed_mph;
    if (!rules.round_speeds_mph.push(speed_mph)) map.fail("brackets_mph", "too many");
  }
}

traffic::LanePlan read_lanes(yaml::StrictMap map) {
  traffic::LanePlan lanes;
  lanes.inside_m = map.number("inside_m", -kLaneReach_m, kLaneReach_m);
  lanes.outside_m = map.number("outside_m", -kLaneReach_m, kLaneReach_m);
  if (lanes.outside_m >= lanes.inside_m)
    map.fail("outside_m", "expected right of inside_m: the inside is on the left");
  map.finish();
  return lanes;
}

void read_expected(yaml::StrictMap& map, MatchPlan& plan) {
  if (map.has("expect"))
    for (const std::string& word : map.texts("expect", 1, rules::kAttemptsMax)) {
      const auto ending = rules::ending_named(word.c_str());
      if (!ending) map.fail("expect", "\"" + word + "\" is no ending of an attempt");
      plan.expect.push_back(*ending);
    }
  if (!map.has("result")) return;
  plan.result = map.text("result");
  if (plan.result == "rival")
    plan.result = plan.rival;
  else if (plan.result != kOwnCar && plan.result != "draw" && plan.result != "open")
    map.fail("result", "\"" + plan.result + "\" is not one of: own, rival, draw, open");
}

MatchPlan read_plan(yaml::StrictMap map, std::vector<OtherCar>& cars) {
  MatchPlan plan;
  plan.place = map.place();
  plan.rival = map.text("rival");
  plan.begins = from_seconds(map.number("begins_s", 0.0, kLongestMatch_s));
  const std::string first = map.text_or("first", kOwnCar);
  if (first != kOwnCar && first != "rival")
    map.fail("first", "\"" + first + "\" is not one of: own, rival");
  plan.rival_first = first == "rival";
  read_brackets(map, plan.rules);
  plan.lanes = read_lanes(map.map("lanes"));
  const auto rival = std::ranges::find(cars, plan.rival, &OtherCar::name);
  if (rival == cars.end()) map.fail("rival", "no other car has the name \"" + plan.rival + "\"");
  for (const char* key : {"attempts", "defends"})
    if (rival->stack && map.has(key)) map.fail(key, "the rival is no ghost: it drives by itself");
  plan.attempts = words_of(map, "attempts", kMannerWords);
  plan.defends = words_of(map, "defends", kDefenceWords);
  read_expected(map, plan);
  map.finish();
  if (!rival->stack) rival->ghost.lanes = plan.lanes;
  return plan;
}

}  // namespace

std::optional<MatchPlan> read_match(yaml::StrictMap& map, std::vector<OtherCar>& cars) {
  auto section = map.optional_map("match");
  if (!section) return std::nullopt;
  return read_plan(*std::move(section), cars);
}

}  // namespace pitwall::scenario
