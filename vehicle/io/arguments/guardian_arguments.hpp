// Command line of pitwall-guardian.
//   errors wrong usage: text on stderr and exit code 2 (0 for --help)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <variant>

#include "vehicle/io/arguments/receiver_link.hpp"

namespace pitwall::io {

struct GuardianArguments {
  std::string car_file, can_interface, guardian, summary_file;  // no summary if empty
  std::string clock = "wall";  // or the file with the time of a bench
  ReceiverLinks receivers;     // the guardian's own links, not the car's
  bool check = false;          // check the car file, report its errors, and exit
  bool simulation = false;     // reported on stderr; no other effect
};

// Returns the arguments, or the exit code.
std::variant<GuardianArguments, int> parse_guardian_arguments(int argc, const char* const* argv);

}  // namespace pitwall::io
