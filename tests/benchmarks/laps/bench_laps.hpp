// Subcommand `pitwall-benchmarks laps [--track FILE] [--only NAME] [--json FILE]`: flying laps of
// the simulated car on Las Vegas, Indianapolis and Texas, nominal and with one parameter of the
// world changed at a time, which the car's own model does not know.
//
//   in     hil/scenarios/*_flying_lap.yaml; --track FILE: that track (YAML) instead of the three
//   out    the table and the gates of tests/benchmarks/laps/lap_table.hpp; two runs at a time
//   errors exit code 1: a gate is missed; 2: bad input
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int bench_laps(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
