// Section `match` of a scenario file: a passing competition of our car and one other.
//   rival      name of the other car, a ghost or a stack
//   begins_s   until then race control plays its own section
//   first      who attacks first: own or rival
//   brackets_mph  round speeds, rising; default: 80, 100, 115, 125, 135, 150
//   lanes      inside_m and outside_m: lanes as offsets from the reference line; they meet halfway
//   attempts   what a ghost does in its own attempts, one after another, the last for the rest:
//              pass, follow, cut_in, early, ram, open_door, decline
//   defends    what a ghost does in those of our car, likewise: hold, slow, wide
//   expect     the endings of the attempts in their order
//   result     own, rival, draw or open
//   errors     thrown as yaml::InputError with the place, for read_scenario()
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hil/scenario/cars_section.hpp"
#include "hil/traffic/ghost_driver.hpp"
#include "protocol/rules/attempt.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall::scenario {

inline constexpr const char* kOwnCar = "own";

struct MatchPlan {
  std::string rival;
  Duration begins{};
  bool rival_first = false;
  rules::PassingRules rules;
  traffic::LanePlan lanes;
  std::vector<traffic::Manner> attempts;
  std::vector<traffic::Defence> defends;
  std::vector<rules::Ending> expect;
  std::string result;   // "own", "draw", "open" or the name of the rival; empty: not expected
  std::string place;    // for messages
  bool is_cut = false;  // the run is shorter: only attempts that were made are judged
};

// A ghost of the match gets its lanes.
std::optional<MatchPlan> read_match(yaml::StrictMap& map, std::vector<OtherCar>& cars);

}  // namespace pitwall::scenario
