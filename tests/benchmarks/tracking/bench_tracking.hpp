// Subcommand `pitwall-benchmarks tracking [--seed N] [--json FILE]`: the paper's tracker and
// ours on the same detections of other cars, in simulation.
//
//   in     the scenes of tracking_plan.hpp; two runs at a time
//   out    the table and gates of tracking_table.hpp, the cost of tracking_cost.hpp
//   errors exit code 1: a gate is missed; 2: bad input
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int bench_tracking(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
