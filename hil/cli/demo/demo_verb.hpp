// Subcommand `pitwall-hil demo`: the whole system in one run, by default a passing competition of
// two attempts each at two round speeds. The base station runs on this machine; our car and the
// bench use real SocketCAN, in a guest if this kernel has no CAN, and the radio between them goes
// over the serial line. Several cars with a full stack are on this machine, each on a Unix-socket
// bus of its own.
//
//   --headless        the base station writes its screen to a file instead of this terminal
//   --cars N          cars with a full stack: 1 (the rival is a ghost; the default) or 2
//   --scenario FILE   another scenario
//   --web PORT        TCP port of the console (default 8080)
//   --duration S      seconds of scenario time; what is judged later is left out
//   --json FILE       the printed results as JSON
//   --out FOLDER      report, event log, candump, recordings (default out/demo); what belongs to
//                     another car is named after it
//   out    exit code that of the run; 1 too where the base did not hear a car under its own keys;
//          2: it could not run
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int demo_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
