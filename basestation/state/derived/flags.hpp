// Comparison of the flags of race control, car and pit wall. The paper's race control once set 125
// mph instead of 115.
//   in     flags and round speed as race control, the car and the pit wall have them; unset where
//          somebody has said none
//   out    conflicts now; how long one must last before it is one is the alarm's on-delay
//   invariants
//          two that are known and differ are a conflict. A car that acts on a more restrictive flag
//          than race control's because the pit wall relays it is none of the car's: the pit wall
//          differs then. A car that wants to go faster than the round's speed is one
//   units  flags as telemetry::kTrackFlags and kVehicleFlags; m/s
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/vocabulary/units.hpp"

namespace pitwall::state {

inline constexpr double kRoundSpeedTolerance_mps = 0.5;  // the brackets are 4.5 m/s apart

struct FlagEntries {
  double race_control_track = kUnset, race_control_vehicle = kUnset;
  double car_track = kUnset, car_vehicle = kUnset;  // that the car acts on
  double pit_wall_track = kUnset;
  double encodings_differ = kUnset;  // 1: the two ways of race control into the car disagree
};
bool flag_conflict(const FlagEntries& flags);

struct RoundSpeeds {
  double race_control_mps = kUnset, pit_wall_mps = kUnset, car_target_mps = kUnset;
};
bool round_speed_conflict(const RoundSpeeds& speeds);

// Which of two flags binds the car more; RED, then black, yellow, green. Unknown flags bind most.
int restriction_of_track_flag(double flag);

}  // namespace pitwall::state
