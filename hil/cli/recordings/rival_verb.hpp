// Subcommand `pitwall-hil rival OWN OTHER`: position of the other car of a race in the coordinates
// of our track, from the GNSS of both recordings.
//   out    gap over time: a summary on standard output, all positions as CSV with --out; exit code
//          0; 1: at no time both cars have a position
//   units  in the column names; times in seconds since our first position
//   errors exit code 2 and a line: an unreadable recording, a car without positions
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int rival_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
