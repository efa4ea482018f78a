// `pitwall-hil awake COMMAND [ARG]...`: runs a command that lives in real time, while no processor
// of this virtual machine falls asleep (see protocol/transport/virtual_machine.hpp). On a machine
// of its own it only runs the command.
//   out    exit code: of COMMAND; 128 + number of the signal that ended it; 2 it cannot be started
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::verbs {

int awake_verb(std::span<const std::string> args);

}  // namespace pitwall::verbs
