// `pitwall-hil run SCENARIO`: one scenario, in lockstep (default) or live.
//
//   --live            real SocketCAN and the real car process; where this kernel has no CAN,
//                     inside a User-mode Linux guest that is booted for it
//   --interface unix:PATH  live without either: a bus over a Unix socket, its hub started if needed
//   --attach          live: the car runs already; what the bench adds is the rest of its world
//   --log FILE        event log (MCAP)       --json FILE   result for programs
//   --hours H         lockstep: again and again, each time with the next seed, until so many hours
//                     have been driven or one failed
//   --report FOLDER   both of these and their page and JUnit file: report.html, junit.xml
//   --progress FILE   one JSON line after the other while the run goes on: hil/bench/progress.hpp
//   --out FOLDER      live: summary of the car, candump of the bus
//   --record FOLDER   live: the car's own recording, which `pitwall-hil compare` drives again
//   out    exit code 0 passed, 1 an expectation failed, 2 bad input or bench failure
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::cli {

struct RunOptions {
  std::string scenario, log_file, json_file, folder = "out/run";
  std::string report_folder;          // empty: no report
  std::string progress_file;          // lines while it goes on; empty: none
  std::string record_folder;          // live: of the car's own recording; empty: none
  std::optional<Duration> duration;   // instead of the scenario's
  std::optional<std::uint64_t> seed;  // likewise
  double hours = 0.0;                 // 0: once
  bool live = false, here = false, candump = false, quiet = false;
  bool cut = false;          // what a shorter duration takes from the scenario is not judged
  bool attach = false;       // live: the car is not ours, it runs already
  bool no_guardian = false;  // live: the car alone, although the guardian's program is there
  std::string interface = "vcan0";
  int bay = 0;                    // live: of the benches that run on this machine at once
  std::uint16_t radio_port = 0;   // live: where the bench passes the car's telemetry on
  std::uint16_t uplink_port = 0;  // live: where answers of the base come; 0: any port
  std::string clock;              // live: see clock_place.hpp
  std::string keys;               // live: folder of the run's keys; empty: new ones
};

int run_scenario(const RunOptions& options);
int run_verb(std::span<const std::string> args);

// Path of this very program, to start it again inside a guest.
std::string own_program();
// Path of another program of the same build, by its folder and name.
std::string beside(const std::string& program);
// The command that runs a scenario live where the interface already exists.
std::vector<std::string> live_command(const RunOptions& options);
// The words of `pitwall-hil bus` that run it in a guest, or here where there is CAN. The radio's
// ports stay those of this machine: a base that runs on it hears the car and is heard.
Result<std::vector<std::string>, Problem> exec_words(const RunOptions& options);

}  // namespace pitwall::cli
