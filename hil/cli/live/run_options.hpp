// Options of one run, as the subcommand `run` reads them and other subcommands set them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::cli {

struct RunOptions {
  std::string scenario, log_file, json_file, folder = "out/run";
  std::optional<std::string> text;    // lockstep: of the scenario, instead of what its file has
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
};

}  // namespace pitwall::cli
