// `pitwall-hil compare`: a car's own recording, driven again by this build and compared with what
// the car said, signal by signal. With --live it is played to the car's process instead.
//   errors exit code 2 and a line: no such recording, a tick that is missing, a file of the car
//          that is wrong; 1: it says something else
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int compare_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
