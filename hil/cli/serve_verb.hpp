// `pitwall-hil serve --socket PATH [--scenarios FOLDER] [--runs FOLDER]`
// Bench server at a socket: hil/cli/bench_server/PROTOCOL.md. A base station that was given the
// same path shows its scenarios and starts them.
//   in     words of the verb; clients at the socket
//   out    runs, each `pitwall-hil run` in a process and a folder of its own
//   errors exit code 2: wrong usage, no such folder, a socket that somebody serves
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int serve_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
