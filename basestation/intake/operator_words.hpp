// What an operator can say, as text: for scripts, the bench and tests; the console has buttons.
//   in     stop controlled|emergency
//          release                    the stop that the car has latched, with the car's challenge
//          take N | renew N | drop N | hand N M      authority of the consoles N and M, 1 .. 254;
//                                     take by who holds it renews
//          exclude SENSOR | admit SENSOR      gnss0, gnss1, imu0, imu1 or wheels: added to or taken
//                                     from the set that was ordered last or that the car tells
//          command NAME ARGUMENT      kCommandTable; "_" for a blank, a number or a label
//          joystick CAP BRAKE         one sample: throttle cap and brake, 0 .. 1
//   out    the endpoint wants it from now on; the number of a command that was given
//   law    commands are given in the name of the console that holds the authority
//   errors Problem with the line as place: unknown words, numbers out of range, authority that
//          somebody else holds, no car to give a command to, a set that nobody knows yet
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "protocol/telemetry/endpoint/station_endpoint.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::intake {

struct Obeyed {
  std::optional<telemetry::CommandId> command;
};

Result<Obeyed, Problem> obey(telemetry::StationEndpoint& station, std::string_view line,
                             Instant now);

// Whether obey() could ever take it: words, names and ranges. For files, before they are needed.
Result<bool, Problem> check_words(std::string_view line);

}  // namespace pitwall::intake
