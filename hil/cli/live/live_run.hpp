// Live run of a scenario, with every car that has a stack: folders, keys, event logs, clock.
//   in     the options of the run, the scenario; for our car a callback after each of its ticks
//   out    its result with those of the other cars; on stdout the timing, unless `quiet`
//   errors Problem of a plan (car_plans.hpp), of a file, of the bench
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/bench/loading.hpp"
#include "hil/bench/progress.hpp"
#include "hil/bench/result.hpp"
#include "hil/cli/live/run_options.hpp"
#include "protocol/recording/mcap_writer.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::cli {

// A sink that writes the file; an empty name gives an empty sink.
Result<recording::Sink, Problem> sink_to(const std::string& path);

Result<bench::RunResult, Problem> run_live(const RunOptions& options, const bench::Loaded& loaded,
                                           const bench::Follow& follow);

}  // namespace pitwall::cli
