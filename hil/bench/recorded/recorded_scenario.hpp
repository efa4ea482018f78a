// Scenario file made from a recorded run: place, car, race control, operator, and what is expected
// of the car in this scenario.
//   in     the facts of the run; the names of the recording, car and track files
//   out    text that hil/scenario reads; its header names the source and what a recording does not
//          hold
//   invariants
//          a simulated run is never the recorded one: the noise differs and the plant is a model.
//          The expectations are therefore: each mode within kModeSlack of its recorded time, no
//          mode that the run did not have, the highest speed within kSpeedShare, and the distance
//          from the line at most kLineSlack_m above the largest of the run
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/bench/recorded/drive_again.hpp"
#include "hil/bench/recorded/run_facts.hpp"

namespace pitwall::bench {

inline constexpr Duration kModeSlack = seconds(1);
inline constexpr double kSpeedShare = 0.1, kLineSlack_m = 0.5;

struct ScenarioSource {
  std::string recording;
  RunFiles files;
};

std::string scenario_text(const RunFacts& facts, const ScenarioSource& source);

}  // namespace pitwall::bench
