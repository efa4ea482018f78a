// Command line of pitwall-vehicle.
//   invariants
//          a car with a base station needs keys: without them the program does not start
//   errors wrong usage: text on stderr and exit code 2 (0 for --help)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "vehicle/io/arguments/receiver_link.hpp"

namespace pitwall::io {

struct Arguments {
  std::string car_file, track_file;
  std::string can_interface;
  ReceiverLinks receivers;                            // links of the receivers
  std::vector<std::string> radio{"127.0.0.1:23431"};  // one per path: see station_addresses.hpp
  std::string keys;                                   // key file of the car
  std::uint16_t local_report = 0;                     // port on loopback; 0: no local report
  std::string clock = "wall";                         // or the file with the time of a bench
  std::string summary_file;                           // empty: none
  std::string record_folder;                          // of the car's recording; empty: none
  std::string sensors_file;                           // sensors over ROS 2 topics; empty: none
  std::optional<int> sensors_domain;                  // instead of the file's
  bool debug_dds = false;                             // what the car sees, over ROS 2 topics
  std::string guardian;     // name of the record shared with the guardian; empty: no guardian
  bool simulation = false;  // marks the telemetry; no other effect
  bool no_base = false;     // no base station: not needed to arm, not watched (benches)
  bool check = false;       // check the files, report their errors, and exit
  bool arm = false;         // armed from the start, like the switch at the car (bench)
};

// Returns the arguments, or the exit code.
std::variant<Arguments, int> parse_arguments(int argc, const char* const* argv);

}  // namespace pitwall::io
