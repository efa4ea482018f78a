// Subcommand `pitwall-hil run SCENARIO`: runs one scenario, in lockstep (default) or live.
//
//   --live            real SocketCAN and the real car process; if this kernel has no CAN, inside a
//                     User-mode Linux guest that is booted for it
//   --interface unix:PATH  live without either: a bus over a Unix socket; starts a missing hub
//   --attach          live: the car is already running; the bench adds the rest of its world
//   --log FILE        event log (MCAP)       --json FILE   result for programs
//   --hours H         lockstep: repeated with the next seed each time, until H hours have been
//                     driven or a run failed
//   --report FOLDER   log and result with their page and JUnit file: report.html, junit.xml
//   --progress FILE   one JSON line per message during the run: hil/bench/progress.hpp
//   --out FOLDER      live: summary of the car, candump of the bus
//   --record FOLDER   live: the car's own recording, which `pitwall-hil compare` replays
//   out    exit code 0 passed, 1 an expectation failed, 2 bad input or bench failure, 4 the car hit
//          a wall and the scenario does not expect it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hil/bench/fault_plan.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::cli {

struct RunOptions {
  std::string scenario, log_file, json_file, folder = "out/run";
  std::string report_folder;          // empty: no report
  std::string progress_file;          // progress lines; empty: none
  std::string record_folder;          // live: folder of the car's own recording; empty: none
  std::string sensors_file;           // live: of the car's sensors on ROS 2 topics; empty: none
  std::optional<Duration> duration;   // replaces that of the scenario
  std::optional<std::uint64_t> seed;  // replaces that of the scenario
  double hours = 0.0;                 // 0: a single run
  bool live = false, here = false, candump = false, quiet = false;
  bool cut = false;          // expectations beyond a shorter duration are not graded
  bool attach = false;       // live: the car was started separately
  bool no_guardian = false;  // live: no guardian, even if its program exists
  std::string interface = "vcan0";
  int bay = 0;                    // live: index among the benches that run on this machine
  std::uint16_t radio_port = 0;   // live: port to which the bench forwards the car's telemetry
  std::uint16_t uplink_port = 0;  // live: port for datagrams of the base; 0: any port
  std::string clock;              // live: see clock_place.hpp
  std::string keys;               // live: folder of the keys of the run; empty: new ones

  bench::BenchMode mode() const {
    return live ? bench::BenchMode::kLive : bench::BenchMode::kLockstep;
  }
};

int run_scenario(const RunOptions& options);
int run_verb(std::span<const std::string> args);

// Path of this program, to start it again inside a guest.
std::string own_program();
// Path of another program of the same build, given by folder and name.
std::string beside(const std::string& program);
// The command that runs a scenario live on an existing interface.
std::vector<std::string> live_command(const RunOptions& options);
// The arguments of `pitwall-hil bus` that run this command in a guest, or here if the kernel has
// CAN. The radio ports stay those of this machine, so that a base on it can communicate with the
// car.
Result<std::vector<std::string>, Problem> exec_arguments(const RunOptions& options);

}  // namespace pitwall::cli
