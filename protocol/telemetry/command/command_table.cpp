// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/command/command_table.hpp"

namespace pitwall::telemetry {

std::string_view text_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::kReceived:
      return "received, not decided";
    case Outcome::kApplied:
      return "applied";
    case Outcome::kRefused:
      return "refused: not in this state";
    case Outcome::kUnsupported:
      return "refused: this car has no such thing";
    case Outcome::kExpired:
      return "expired: too late";
    case Outcome::kSuperseded:
      return "superseded by a newer one";
    case Outcome::kNoAuthority:
      return "refused: its console does not hold the authority";
    case Outcome::kOtherRun:
      return "refused: meant for the run of the car before";
  }
  return "?";
}

}  // namespace pitwall::telemetry
