// Subcommand `pitwall-hil convert IN OUT`: conversion of a CAN log into another format.
//
//   convert IN OUT [--strict] [--progress]
//   OUT    the suffix gives the format: .log (candump), .asc, .blf, .trc, .pcap, .pcapng; a further
//          .gz compresses with gzip
//   out    the file. On standard error: what of IN was left out, and what the format of OUT cannot
//          keep. Exit code 0: written; 1: with --strict, something was left out or is not kept;
//          2: wrong usage, IN is not a CAN log, or OUT cannot be written
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int convert_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
