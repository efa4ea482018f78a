// Subcommand `pitwall-hil compare`: replays a car's own recording in the pipeline of this build and
// compares the result with the recording, signal by signal. With --live the car process replays it
// instead.
//   errors exit code 2 and a line: no such recording, a missing tick, an invalid file of the car;
//          1: differences found
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int compare_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
