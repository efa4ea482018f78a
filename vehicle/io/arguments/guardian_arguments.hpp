// The command line of pitwall-guardian.
//   errors wrong usage: text on stderr and exit code 2 (0 for --help)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <variant>

#include "vehicle/io/arguments/receiver_link.hpp"

namespace pitwall::io {

struct GuardianArguments {
  std::string car_file, can_interface, guardian, summary_file;  // no summary if empty
  std::string clock = "wall";  // or the file in which a bench keeps time
  ReceiverLinks receivers;     // links of its own, not the car's
  bool check = false;          // read the car file, say what is wrong with it, and stop
  bool simulation = false;     // said on stderr; decides nothing
};

// Arguments, or the code to exit with.
std::variant<GuardianArguments, int> parse_guardian_arguments(int argc, const char* const* argv);

}  // namespace pitwall::io
