// Subcommand `pitwall-hil scenario from RECORDING`: makes a scenario file from a car's own
// recording.
//   out    the scenario, on standard output or in a file
//   errors exit code 2 and a line: no such recording, a missing tick, a car that never had a
//          position, a file that cannot be written
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int scenario_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
