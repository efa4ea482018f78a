// `pitwall-benchmarks laps [--track FILE] [--only NAME] [--json FILE]`: the car of the scenario
// files on Las Vegas, Indianapolis and Texas, nominal and with one thing at a time different from
// what it believes.
//
//   in     hil/scenarios/*_flying_lap.yaml; with --track a track file (YAML), alone
//   out    the table and the gates of tests/benchmarks/laps/lap_table.hpp; two runs at a time
//   errors exit code 1: a gate is missed; 2: bad input
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int bench_laps(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
