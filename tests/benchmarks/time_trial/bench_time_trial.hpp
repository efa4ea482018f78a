// `./pitwall bench time_trial`: laps of Las Vegas at the limit, with many seeds.
//   in     the command line
//   out    a table, with --json a file; exit code 0: every gate holds
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int bench_time_trial(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
