// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/flag_speed.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::planning {
namespace {

using world::FlagDemand;
using world::TrackFlag;
using world::VehicleFlag;

Reason reason_of(TrackFlag flag) {
  switch (flag) {
    case TrackFlag::kNone:
      return Reason::kNoFlag;
    case TrackFlag::kRed:
      return Reason::kRed;
    case TrackFlag::kOrange:
      return Reason::kOrange;
    case TrackFlag::kYellow:
      return Reason::kCaution;
    case TrackFlag::kGreen:
    case TrackFlag::kWavingGreen:
      return Reason::kGreen;
    case TrackFlag::kChequered:
      return Reason::kChequered;
    case TrackFlag::kUnknown:
      break;
  }
  return Reason::kUnknownFlag;
}

Reason reason_of(VehicleFlag flag) {
  switch (flag) {
    case VehicleFlag::kNone:
    case VehicleFlag::kBlue:
    case VehicleFlag::kDefender:
    case VehicleFlag::kAttacker:
      return Reason::kGreen;
    case VehicleFlag::kYellow:
      return Reason::kCaution;
    case VehicleFlag::kBlackPitIn:
      return Reason::kBlack;
    case VehicleFlag::kStop:
    case VehicleFlag::kPurpleEmergency:
    case VehicleFlag::kEngineKill:
      return Reason::kStopFlag;
    case VehicleFlag::kOrangeStartEngine:
      return Reason::kOrange;
    case VehicleFlag::kChequered:
      return Reason::kChequered;
    case VehicleFlag::kUnknown:
      break;
  }
  return Reason::kUnknownFlag;
}

}  // namespace

SpeedDemand demanded_speed(const FlagSpeeds& speeds, const world::RaceControl& rc,
                           double operator_speed_limit_mps) {
  if (!rc.ever_received) return {0.0, Reason::kNoRaceControl};
  const FlagDemand asked = demand_of(rc.track, rc.vehicle);
  const bool by_vehicle = demand_of(rc.vehicle) >= demand_of(rc.track);
  SpeedDemand demand{0.0, by_vehicle ? reason_of(rc.vehicle) : reason_of(rc.track)};
  if (asked == FlagDemand::kRace) {
    const bool given = rc.round_target_speed_mps > 0.0 && std::isfinite(rc.round_target_speed_mps);
    demand = {.speed_mps = given ? rc.round_target_speed_mps : speeds.green_mps,
              .reason = given ? Reason::kRoundSpeed : Reason::kGreen,
              .races = true};
  } else if (asked == FlagDemand::kCaution || (asked == FlagDemand::kComeIn && speeds.has_pit)) {
    demand.speed_mps = speeds.caution_mps;
  }
  if (operator_speed_limit_mps < demand.speed_mps)
    demand = {std::max(operator_speed_limit_mps, 0.0), Reason::kOperatorLimit};
  return demand;
}

}  // namespace pitwall::planning
