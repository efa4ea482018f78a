// Live comparison, `pitwall-hil compare RECORDING --live`: replays the recording to pitwall-vehicle
// over its bus and its receiver ports, and compares modes and commands of the car within the
// tolerances of hil/bench/recorded/command_comparison.
//   in     the recording; an existing CAN interface, or unix:PATH, whose hub is started
//   out    exit code 0: same modes, and commands within tolerance; 1: something differs. The
//          recorded inputs that were not replayed; the new recording of the car in a new folder
//          under `folder`
//   errors exit code 2 and a line: a recording that cannot be replayed, no such interface, a car
//          that does not start
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/bench/recorded/drive_again.hpp"

namespace pitwall::cli {

struct LiveComparison {
  std::string recording, json_file;
  bench::RunFiles files;
  std::string interface = "vcan0", folder = "out/compare", clock;
};

int compare_live(const LiveComparison& options);

}  // namespace pitwall::cli
