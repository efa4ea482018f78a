// `pitwall-hil desk --socket PATH [--scenarios FOLDER] [--runs FOLDER]`
// The bench at somebody else's command, over a socket: hil/desk/PROTOCOL.md. A pit wall that was
// given the same path shows its scenarios and starts them.
//   in     words of the verb; clients at the socket
//   out    runs, each `pitwall-hil run` in a process and a folder of its own
//   errors exit code 2: wrong usage, no such folder, a socket that somebody serves
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::verbs {

int desk_verb(std::span<const std::string> args);

}  // namespace pitwall::verbs
