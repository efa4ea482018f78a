// `pitwall-hil scenario from RECORDING`: makes a scenario file from a car's own recording
// (pitwall-vehicle --record), which `run` drives in a modelled world.
//   out    the scenario, on standard output or in a file
//   errors exit code 2 and a line: no such recording, a missing tick, a car that never had a
//          position, a file that cannot be written
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/bench/recorded/drive_again.hpp"
#include "hil/cli/command_line.hpp"

namespace pitwall::cli {

struct ScenarioFromOptions {
  std::string recording, out_file;
  bench::RunFiles files;
};

void add_options(CommandLine& verb, ScenarioFromOptions& options);
int scenario_from(const ScenarioFromOptions& options);

}  // namespace pitwall::cli
