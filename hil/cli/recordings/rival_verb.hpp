// `pitwall-hil rival OWN OTHER`: where the other car of a race was, in our track's coordinates, by
// the GNSS of both recordings.
//   out    gap by time: a summary on standard output, all positions as CSV with --out; exit code 0;
//          1: at no time both cars have a position
//   units  columns say theirs; times in seconds since our first position
//   errors exit code 2 and a line: a recording that does not read, a car without positions
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int rival_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
