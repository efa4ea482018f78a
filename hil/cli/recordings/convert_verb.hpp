// `pitwall-hil convert IN OUT`: a CAN log of any format as a file of another one.
//
//   convert IN OUT [--strict] [--progress]
//   OUT    .log (candump), .asc, .blf, .trc, .pcap, .pcapng; with .gz behind it: packed by gzip
//   out    the file; what was left out of IN and what the format of OUT cannot keep on standard
//          error. Exit code 0: written, 1: with --strict, something was left out or is not kept,
//          2: wrong usage, no CAN log, or OUT cannot be written
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int convert_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
