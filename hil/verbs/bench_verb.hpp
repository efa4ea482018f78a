// `pitwall-hil bench NAME [--json FILE]`: benchmarks that are runs of the bench itself.
//   ekf        what the filter of localization costs the car; gates in bench_ekf.hpp
//   gateway    27,000 frames/s and every lost frame reported; options in bench_gateway.hpp
//   laps       three ovals, nominal and perturbed; gates in hil/laps/lap_table.hpp
//   lockstep   how much faster than real time the closed loop runs; gate: at least 50 times
//   plant      what a step of the modelled car costs; gates in bench_plant.hpp
//   radio      our radio protocol beside others over one emulated link; bench_radio.hpp
//   replay     timing of replays beside canplayer and python-can; options in bench_replay.hpp
//   step       how long one step of the car takes in that loop; gates: p50 below 100 us, p99 below
//              1.2 ms (planning, late measurements)
//   out    a table; exit code 1 when a gate is missed, 2 for an unknown name
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::verbs {

int bench_verb(std::span<const std::string> args);

}  // namespace pitwall::verbs
