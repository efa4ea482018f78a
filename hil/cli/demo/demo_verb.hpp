// `pitwall-hil demo`: the whole system at work. Base station on this machine; car and bench on real
// SocketCAN, in a guest where this kernel has no CAN; the radio between them over the serial line.
// Of several cars each has its guest, keys, folder and station; they share the base's process.
//
//   --headless        the base station writes its screen to a file instead of this terminal
//   --cars N          so many cars at one base, each with a bench of its own (default 1)
//   --web PORT        TCP port of the console (default 8080)
//   --duration S      seconds of scenario time (default 180)
//   --json FILE       everything that is printed, for programs
//   --out FOLDER      event log, candump, summaries (default out/demo); of several cars
//                     a folder for each in it
//   out    exit code 0: every expectation held, no frame was lost; 1: not so; 2: it could not run
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int demo_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
