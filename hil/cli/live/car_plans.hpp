// Plans of a live run: one for each car with a stack, ours first.
//   in     the options of the run and its scenario
//   out    plans without keys, clock and log, which are opened when the run starts
//   invariants
//          cars share no port, shared memory, bus or file. What another car writes is named after
//          it, file_of(), or is in the folder of its name below that of the run. Several cars have
//          one base station: the plan of the first one starts it, or it is there at --radio-port,
//          and hears each next car kBayPorts further on, with the keys of file_of(--keys)
//   errors Problem: several cars that have no bus each, or more than this machine has bays for;
//          options that are of one car only
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "hil/bench/live/live_plan.hpp"
#include "hil/bench/loading.hpp"
#include "hil/cli/live/run_options.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::cli {

inline constexpr int kOurNumber = 1;  // as in the scenario file

// "out/events.mcap" becomes "out/events.rival.mcap" for the car "rival"; empty stays empty.
std::string file_of(const std::string& car, const std::string& file);

Result<std::vector<bench::LivePlan>, Problem> plans_of(const RunOptions& options,
                                                       const bench::Loaded& loaded);

}  // namespace pitwall::cli
