// Subcommand `pitwall-hil scenario`: scenario files, without a run.
//   new FILE        a small scenario to start from; never replaces a file
//   check FILE...   each file with all that it names
//   list [FOLDER]   a table of the scenarios in a folder and its subfolders
//   from RECORDING  a scenario of a car's own recording
//   errors exit code 2 and a line for each file with a problem, after those without one
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int scenario_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
