// Subcommand `pitwall-benchmarks dbc [--json FILE]`: speed of reading CAN databases and of decoding
// frames.
//
//   in     protocol/can/dbc/av21.dbc (all messages) and a synthetic file of 800 kB
//   out    signals decoded and encoded per second on one core, by run-time plans and by generated
//          code; time to read the large file; the same by canmatrix if /usr/bin/python3 has it
//   gates  decoding by run-time plans >= 20 million signals/s, reading 800 kB < 100 ms; exit code 1
//          if one is missed
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int bench_dbc(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
