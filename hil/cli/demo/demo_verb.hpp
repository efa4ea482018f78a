// Subcommand `pitwall-hil demo`: a run of the whole system. The base station runs on this machine;
// car and bench use real SocketCAN, in a guest if this kernel has no CAN; the radio between them
// goes over the serial line. With several cars, each has its own guest, keys, folder and station;
// they share the process of the base.
//
//   --headless        the base station writes its screen to a file instead of this terminal
//   --cars N          number of cars at one base, each with a bench of its own (default 1)
//   --web PORT        TCP port of the console (default 8080)
//   --duration S      seconds of scenario time (default 180)
//   --json FILE       the printed results as JSON
//   --out FOLDER      event log, candump, summaries (default out/demo); with several cars a
//                     subfolder for each
//   out    exit code 0: every expectation passed and no frame was lost; 1: otherwise; 2: it could
//          not run
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int demo_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
