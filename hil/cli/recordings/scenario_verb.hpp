// `pitwall-hil scenario from RECORDING`: a car's own recording as a scenario file.
//   out    the scenario, on standard output or in a file
//   errors exit code 2 and a line: no such recording, a tick that is missing, a car that never
//          knew where it was, a file that cannot be written
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int scenario_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
