// Subcommand `pitwall-hil run SCENARIO`: runs one scenario, in lockstep (default) or live.
//
//   --live            real SocketCAN and the real car process; if this kernel has no CAN, inside a
//                     User-mode Linux guest that is booted for it
//   --interface unix:PATH  live without either: a bus over a Unix socket; starts a missing hub.
//                     Several cars with a stack have a bus each (live/car_plans.hpp)
//   --attach          live: the car is already running; the bench adds the rest of its world
//   --log FILE        event log (MCAP)       --json FILE   result for programs
//   --hours H         lockstep: repeated with the next seed each time, until H hours have been
//                     driven or a run failed
//   --report FOLDER   log and result with their page and JUnit file: report.html, junit.xml
//   --progress FILE   one JSON line per message during the run: hil/bench/progress.hpp
//   --out FOLDER      live: summary of the car, candump of the bus
//   --record FOLDER   live: the car's own recording, which `pitwall-hil compare` replays
//   out    exit code 0 passed, 1 an expectation failed, 2 bad input, bench failure or a run that
//          was not judged, 4 the car hit a wall and the scenario does not expect it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "hil/cli/live/run_options.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::cli {

int run_scenario(const RunOptions& options);
// As the verb runs these options: where the bus is, in a guest or here, with files for the report.
int run_as_told(RunOptions options);
int run_verb(std::span<const std::string> args);

// The command that runs a scenario live on an existing interface.
std::vector<std::string> live_command(const RunOptions& options);
// The arguments of `pitwall-hil bus` that run this command in a guest, or here if the kernel has
// CAN. The radio ports stay those of this machine, so that a base on it can communicate with the
// car. `other_buses`: of other cars with a stack.
Result<std::vector<std::string>, Problem> exec_arguments(
    const RunOptions& options, std::span<const std::string> other_buses = {});

}  // namespace pitwall::cli
