// The command line of pitwall-vehicle.
//   errors wrong usage: text on stderr and exit code 2 (0 for --help)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "vehicle/world/sensor_input.hpp"

namespace pitwall::io {

struct Arguments {
  std::string car_file, track_file;
  std::string can_interface;
  std::array<std::uint16_t, world::kGnssUnits> gnss_ports{};
  std::string radio = "127.0.0.1:23431";
  std::string summary_file;  // empty: none
  std::string guardian;      // name of the record shared with the guardian; empty: there is none
  bool simulation = false;   // marks the telemetry; decides nothing
  bool no_base = false;      // no base station: none is needed to arm, none is missed (benches)
  bool check = false;        // read the files, say what is wrong with them, and stop
  bool arm = false;  // armed from the start: for benches, until an operator can arm by radio
};

// Arguments, or the code to exit with.
std::variant<Arguments, int> parse_arguments(int argc, const char* const* argv);

}  // namespace pitwall::io
