// `pitwall-hil info FILE`: what a CAN log holds, whatever format it has.
//
//   info FILE [--json FILE] [--strict] [--progress]
//   out    format, span in calendar time, frames, channels, one row for each identifier (count,
//          rate, least and greatest gap) and all counters on standard output; remarks and notes on
//          standard error. Exit code 0: the log reads, 1: with --strict, records were left out,
//          2: wrong usage, or no CAN log
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int info_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
