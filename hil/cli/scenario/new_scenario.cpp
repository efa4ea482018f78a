// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/scenario/new_scenario.hpp"

#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::cli {
namespace {

constexpr const char* kPattern =
    R"(# What this scenario shows, in a sentence: lists and the console have it from here.

# yaml-language-server: $schema=%s
schema: 1
name: %s
seed: 1                 # of all noise; another seed is another run
duration_s: %s
track: %s
car: %s
start: {s_m: 0, n_m: 0} # along the reference line of the track, and left of it
race_control:           # one entry after another, each until the next
  - {at_s: 0.5, track: red}
  - {at_s: 4, track: orange}                             # the engine starts
  - {at_s: 9, track: yellow, round_target_speed_mph: 60} # the car drives away
faults: []              # such as {kind: gnss_unit_outage, unit: 1, at_s: 20, for_s: 5}
expect:                 # more kinds: docs/bench.md
  - {kind: always, signal: wall_gap_m, is: ">", value: 0.5}
  - {kind: never, signal: mode, is: ">=", value: 3}
  - {kind: within, signal: speed_mps, is: ">", value: 10, from_s: 9}
  - {kind: quantile, quantile: 0.99, signal: abs_cross_track_m, is: "<", value: 1}
)";

}  // namespace

std::string new_scenario_text(const NewScenario& scenario) {
  return formatted(kPattern, scenario.schema.c_str(), json::quoted(scenario.name).c_str(),
                   shortest(scenario.duration_s).c_str(), json::quoted(scenario.track).c_str(),
                   json::quoted(scenario.car).c_str());
}

}  // namespace pitwall::cli
