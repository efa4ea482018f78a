// Subcommand `pitwall-hil serve --socket PATH [--scenarios FOLDER] [--runs FOLDER]`
// Bench server at a Unix socket: hil/cli/bench_server/PROTOCOL.md. A base station with the same
// path shows its scenarios and starts them.
//   in     arguments of the subcommand; clients at the socket
//   out    runs, each `pitwall-hil run` in a process and a folder of its own
//   errors exit code 2: wrong usage, no such folder, a socket that another process serves
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int serve_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
