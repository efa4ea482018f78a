// The command line of pitwall-vehicle.
//   invariants
//          a car whose base station is watched has keys: without them nothing starts
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
  ReceiverLinks receivers;                            // where the bytes of each come in
  std::vector<std::string> radio{"127.0.0.1:23431"};  // by path: see station_addresses.hpp
  std::string keys;                                   // file of the car's keys
  std::uint16_t local_report = 0;                     // port on loopback; 0: nobody is told
  std::string clock = "wall";                         // or the file in which a bench keeps time
  std::string summary_file;                           // empty: none
  std::string record_folder;                          // of the car's own recording; empty: none
  std::string sensors_file;                           // of sensors over ROS 2 topics; empty: none
  std::string guardian;     // name of the record shared with the guardian; empty: there is none
  bool simulation = false;  // marks the telemetry; decides nothing
  bool no_base = false;     // no base station: none is needed to arm, none is missed (benches)
  bool check = false;       // read the files, say what is wrong with them, and stop
  bool arm = false;         // armed from the start, as by a switch at the car (bench)
};

// Arguments, or the code to exit with.
std::variant<Arguments, int> parse_arguments(int argc, const char* const* argv);

}  // namespace pitwall::io
