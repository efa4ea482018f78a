// Subcommand `pitwall-benchmarks perception [--network FILE] [--scenes N] [--seed N]
// [--errors FILE] [--json FILE]`: LiDAR detectors
// on drawn scenes, in simulation.
//
//   in     scenes with another body, another track and more dust than any that a detector was made
//          on; beside them scenes of the kind that it was made on
//   out    the table of detection_table.hpp, the cost of detector_cost.hpp
//   errors exit code 1: a gate is missed; 2: bad input
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int bench_perception(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
