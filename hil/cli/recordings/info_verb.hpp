// Subcommand `pitwall-hil info FILE`: contents of a CAN log of any format.
//
//   info FILE [--json FILE] [--strict] [--progress]
//   out    on standard output: format, span in calendar time, frames, channels, one row for each
//          identifier (count, rate, smallest and largest gap) and all counters; remarks and notes
//          on standard error. Exit code 0: the log was read; 1: with --strict, records were left
//          out; 2: wrong usage, or not a CAN log
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int info_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
