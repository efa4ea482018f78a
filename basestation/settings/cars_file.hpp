// Cars that one base serves: one from the command line, or those of a file.
//   in     YAML, a mapping for each car
//   out    the command line of each car: that of the whole base with the options of
//          this car added
//   invariants
//          cars share nothing: number, keys, radio, recording and every other file or device
//          belong to one car only
//   errors Problem with file, line and column: no car or more than kCarsMax, unknown keys, numbers
//          out of range, a resource that two cars would share
//
//   cars:
//     - number: 7                     0..255, shown everywhere
//       name: Blue                    shown name (optional, like all that follows keys)
//       keys: keys/7/base.keys        files are relative to this one, unless they start with /
//       stamp_file: state/7.stamp     as --stamp-file, or none
//       listen: [0.0.0.0:23431]       one or two radios
//       track: lvms                   name, or file with a / in it
//       record: recordings/7
//       judgement: judgement_7.yaml
//       budget_kbit_s: 256
//       signed: false
//       joystick: /dev/input/event3
//       joystick_axes: lift=2:0:255,brake=5:0:255,enable=304
//       stop_port: 23437
//       command_socket: blue.commands
//       command: words_7.txt
//       json: summary_7.json
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "basestation/settings/arguments.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::settings {

inline constexpr std::size_t kCarsMax = 4;

// In the order in which consoles show them. Without --cars: the command line itself.
Result<std::vector<Arguments>, Problem> cars_of(const Arguments& arguments);
// `folder`: base of relative file names.
Result<std::vector<Arguments>, Problem> read_cars_text(std::string_view text,
                                                       const std::string& name,
                                                       const std::string& folder,
                                                       const Arguments& whole);

}  // namespace pitwall::settings
