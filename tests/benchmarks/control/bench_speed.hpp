// Subcommand `pitwall-benchmarks speed [--only NAME] [--json FILE]`: the paper's longitudinal law
// and ours, each with its steering, through the same calls, in the same run.
//
//   in     hil/scenarios/{lvms,ims,tms}_flying_lap.yaml and the car file that they name
//   out    the table and the gates of speed_table.hpp; two runs at a time
//   errors exit code 1: a gate is missed; 2: bad input
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int bench_speed(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
