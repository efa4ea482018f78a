// Comparison of the flags of race control, car and pit wall. In the paper, race control once set
// 125 mph instead of 115.
//   in     flags and round speed of race control, the car and the pit wall; unset for each of them
//          that gives none
//   out    whether they conflict now; the on-delay of the alarm sets how long this must last
//   invariants
//          two known and different values are a conflict. If the pit wall relays a more restrictive
//          flag than race control's and the car acts on it, the conflict is between pit wall and
//          race control, not with the car. A target speed of the car above the round speed is a
//          conflict too, but for an attacker, who closes up and passes faster, and for a car
//          that brakes down to it, as after its attack
//   units  flags as telemetry::kTrackFlags and kVehicleFlags; m/s
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/vocabulary/units.hpp"

namespace pitwall::state {

inline constexpr double kRoundSpeedTolerance_mps = 0.5;  // the brackets are 4.5 m/s apart
inline constexpr double kBrakesDown_mps2 = -0.5;

struct FlagEntries {
  double race_control_track = kUnset, race_control_vehicle = kUnset;
  double car_track = kUnset, car_vehicle = kUnset;  // that the car acts on
  double pit_wall_track = kUnset;
  double encodings_differ = kUnset;  // 1: the two ways of race control into the car disagree
};
bool flag_conflict(const FlagEntries& flags);

struct RoundSpeeds {
  double race_control_mps = kUnset, pit_wall_mps = kUnset, car_target_mps = kUnset;
  double car_vehicle = kUnset;  // flag that the car acts on
  double car_forward_mps2 = kUnset;
};
bool round_speed_conflict(const RoundSpeeds& speeds);

// Rank of a flag, higher for a more restrictive one. In falling order: unknown, RED, ORANGE,
// CHEQUERED, YELLOW, none (as a command it lifts the pit wall's flag), GREEN, WAVING GREEN.
int restriction_of_track_flag(double flag);

}  // namespace pitwall::state
