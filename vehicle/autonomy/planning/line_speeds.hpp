// Speeds of a line: its fastest lap on the envelope of the car, for each row of the table of tyre
// temperatures.
//   in     a line with its places; the envelope on warm tyres; the line of a bank that it is, with
//          the share of the friction that the bank was made for
//   out    the speeds at each point, the time of a lap
//   invariants
//          the lap is that of envelope/lap_profile.hpp; on tyres as warm as those of the bank or
//          colder it is not faster than the bank's own: this car's speed where it is less
//          where no speed carries the car on such tyres every speed is zero: it does not start
//   errors none
//   cost   some 20 ms for each row; start-up only
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "vehicle/autonomy/planning/line.hpp"
#include "vehicle/envelope/envelope_table.hpp"

namespace pitwall::planning {

// What the car can do on the roads of a track, on warm tyres.
envelope::EnvelopeParams envelope_of(const LineParams& params, const world::TrackMap& track,
                                     const std::optional<envelope::SteeringLimit>& steering);

struct BankLap {
  const world::Raceline& line;
  double tyre_share = 1.0;
};

void add_speeds(const envelope::EnvelopeParams& car, const std::optional<BankLap>& of_bank,
                Line& line);

}  // namespace pitwall::planning
