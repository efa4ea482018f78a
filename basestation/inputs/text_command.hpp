// Text commands of operators: for scripts, the command socket, the bench and tests. Consoles have
// buttons instead.
//   in     stop controlled|emergency
//          release [because REASON]   the stop that the car has latched, with the car's challenge
//          take [N] | renew [N] | drop [N]    the authority, as console N (1 .. 15); without N as
//          request | grant | refuse           the console that this operator had before
//          exclude SENSOR | admit SENSOR      gnss0, gnss1, imu0, imu1 or wheels: added to or taken
//                                     from the set that was ordered last or that the car reports
//          command NAME ARGUMENT [because REASON]   kCommandTable; "_" for a blank, a number or a
//                                     label; with a reason if a gate is overridden
//          ack all | ack ALARM | reset ALARM      by the alarm's key
//          joystick CAP BRAKE         one sample: throttle cap and brake, 0 .. 1
//   out    the request, as the request executor takes it
//   errors Problem with the line as place: unknown words, numbers out of range
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <variant>

#include "basestation/command/request.hpp"
#include "protocol/telemetry/command/joystick.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::inputs {

struct ClaimAs {
  command::Claim claim = command::Claim::kTake;
  telemetry::HolderId console = 0;
};
using TextCommand = std::variant<command::Request, telemetry::JoystickSample, ClaimAs>;

// For files too, whose lines are checked before they are due.
Result<TextCommand, Problem> parse_text_command(std::string_view line);

}  // namespace pitwall::inputs
