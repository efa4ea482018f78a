// Speed that flags and operator demand, and which of them demands it.
//   in     RaceControl as the car acts on it, the operator's limit, the speeds of the car's file
//   out    the lowest of all speeds, its reason, and whether the car races for it
//   invariants
//          a flag allows what world::demand_of() says of it: nothing but green of some kind allows
//          more than the caution speed
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/race_control.hpp"

namespace pitwall::planning {

// Source of the target speed.
enum class Reason : std::uint8_t {
  kUnknown,
  kNoEgo,
  kNoRaceControl,
  kNoFlag,
  kUnknownFlag,
  kRed,
  kOrange,
  kBlack,
  kStopFlag,
  kChequered,
  kCaution,
  kGreen,
  kRoundSpeed,
  kOperatorLimit,
  kLineLimit,    // what the car can do at this place of its line
  kTyreLimit,    // the same, where warm tyres could do more
  kCornerAhead,  // the governor slows the car for what lies ahead
  kTrail,        // behind the rival
  kPass,
  kGiveWay,   // a pass was given up
  kCarAhead,  // a car in the way
  kDeclined,  // an attempt, for want of fuel
  kFuelHome,  // fuel for the way home, and no more
  kPitLane,   // its speed limit
  kBox        // towards the box and in it
};

struct SpeedDemand {
  double speed_mps = kUnset;
  Reason reason = Reason::kUnknown;
  bool races = false;  // for what race control wants on a green track, and for nothing else
};

struct FlagSpeeds {
  double green_mps = kUnset;    // if race control gives no round speed
  double caution_mps = kUnset;  // under yellow, and on the way in
  bool has_pit = false;         // a car that shall come in has somewhere to go
};

inline bool is_racing(const world::RaceControl& rc) {
  return rc.ever_received && demand_of(rc.track, rc.vehicle) == world::FlagDemand::kRace;
}

SpeedDemand demanded_speed(const FlagSpeeds& speeds, const world::RaceControl& race_control,
                           double operator_speed_limit_mps);

}  // namespace pitwall::planning
