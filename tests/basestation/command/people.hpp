// Three operators for the tests of commands.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "basestation/command/audit.hpp"

namespace pitwall::command {

inline const Person kAda{17, "Ada"}, kBob{18, "Bob"}, kEve{19, "Eve"};

}  // namespace pitwall::command
