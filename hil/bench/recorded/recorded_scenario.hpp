// Scenario file made of a recorded run: where, which car, what race control and the operator said,
// and what is expected of the car when it is driven in that world again.
//   in     the facts of the run, the names of recording, car and track file
//   out    text that hil/scenario reads; its header names the source and what no recording tells
//   invariants
//          another world is never the recorded one: other noise, a modelled plant. So expected are
//          each mode within kModeSlack of when it was, no mode that was not, the highest speed
//          within kSpeedShare, and the line within what the run left it and kLineSlack_m
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
