// `pitwall-hil bench NAME [--json FILE]`: benchmarks that are runs of the bench itself.
//   ekf        what the filter of localization costs the car; gates in bench_ekf.hpp
//   gateway    27,000 frames/s and every lost frame reported; options in bench_gateway.hpp
//   laps       three ovals, nominal and perturbed; gates in hil/laps/lap_table.hpp
//   lockstep   how much faster than real time the closed loop runs; gate: a second costs at most
//              what 50 times real time is on the reference machine
//   plant      what a step of the modelled car costs; gates in bench_plant.hpp
//   radio      our radio protocol beside others over one emulated link; bench_radio.hpp
//   replay     timing of replays beside canplayer and python-can; options in bench_replay.hpp
//   step       what one step of the car costs in that loop; gates: p50 100 us, p99 1.2 ms on that
//              machine (planning, late measurements)
//   out    a table; exit code 1 when a gate is missed, 2 for an unknown name
//   how    processor time in reference units of the same run, see hil/cost/cost_gates.hpp: a busy
//          neighbour or a slower machine moves the figures and not the verdict
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::verbs {

int bench_verb(std::span<const std::string> args);

}  // namespace pitwall::verbs
