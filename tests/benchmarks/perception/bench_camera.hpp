// Subcommand `pitwall-benchmarks camera [--network FILE] [--images N] [--seed N] [--json FILE]`:
// the camera's detector on drawn images, in simulation.
//
//   in     images of another body and track than any that it was trained on, and with more dust;
//          beside them some of the kind of its training
//   out    the table of camera_score.hpp, the cost of camera_run.hpp
//   errors exit code 1: a gate is missed; 2: bad input
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int bench_camera(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
