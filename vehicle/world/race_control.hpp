// Flags of race control in one typed form for both encodings of the tracks (MyLaps or Marelli;
// value 1 is red in one and green in the other), what each flag asks of the car, and which of two
// flags binds more. Planning, supervisor and gateway read these tables and have none of their own.
//   invariants
//          a value that is in no table of an encoding is kUnknown and asks for a stop, never for
//          racing
//          of two flags the one that asks for more is the more restrictive; of a track flag and a
//          vehicle flag both hold
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::world {

enum class TrackFlag : std::uint8_t {
  kNone,
  kRed,
  kOrange,
  kYellow,
  kGreen,
  kWavingGreen,
  kChequered,
  kUnknown
};

enum class VehicleFlag : std::uint8_t {
  kNone,
  kBlackPitIn,
  kBlue,
  kStop,
  kPurpleEmergency,
  kEngineKill,
  kOrangeStartEngine,
  kYellow,
  kChequered,
  kDefender,
  kAttacker,
  kUnknown
};

// What a flag asks of a car that drives, in rising order of restriction.
enum class FlagDemand : std::uint8_t {
  kNothing,         // a vehicle flag with nothing to add to the track's
  kRace,            // at the round speed; waving green and the role say who may pass
  kCaution,         // slowly, behind whoever is ahead
  kComeIn,          // slowly to the end of the lap, by the pit lane to the box; without one: stop
  kStand,           // planned stop on the track
  kControlledStop,  // and no engine
  kEmergencyStop
};

template <class Flag>
struct FlagRow {
  Flag flag;
  FlagDemand demand;
};

// From the most to the least restrictive, with every enumerator once. Before race control has said
// anything (kNone) the car stands, and with orange it may start its engine.
inline constexpr std::array kTrackFlagTable{
    FlagRow<TrackFlag>{TrackFlag::kUnknown, FlagDemand::kStand},
    FlagRow<TrackFlag>{TrackFlag::kRed, FlagDemand::kStand},
    FlagRow<TrackFlag>{TrackFlag::kNone, FlagDemand::kStand},
    FlagRow<TrackFlag>{TrackFlag::kOrange, FlagDemand::kStand},
    FlagRow<TrackFlag>{TrackFlag::kChequered, FlagDemand::kComeIn},
    FlagRow<TrackFlag>{TrackFlag::kYellow, FlagDemand::kCaution},
    FlagRow<TrackFlag>{TrackFlag::kGreen, FlagDemand::kRace},
    FlagRow<TrackFlag>{TrackFlag::kWavingGreen, FlagDemand::kRace}};

inline constexpr std::array kVehicleFlagTable{
    FlagRow<VehicleFlag>{VehicleFlag::kPurpleEmergency, FlagDemand::kEmergencyStop},
    FlagRow<VehicleFlag>{VehicleFlag::kEngineKill, FlagDemand::kControlledStop},
    FlagRow<VehicleFlag>{VehicleFlag::kUnknown, FlagDemand::kStand},
    FlagRow<VehicleFlag>{VehicleFlag::kStop, FlagDemand::kStand},
    FlagRow<VehicleFlag>{VehicleFlag::kOrangeStartEngine, FlagDemand::kStand},
    FlagRow<VehicleFlag>{VehicleFlag::kBlackPitIn, FlagDemand::kComeIn},
    FlagRow<VehicleFlag>{VehicleFlag::kChequered, FlagDemand::kComeIn},
    FlagRow<VehicleFlag>{VehicleFlag::kYellow, FlagDemand::kCaution},
    FlagRow<VehicleFlag>{VehicleFlag::kBlue, FlagDemand::kNothing},
    FlagRow<VehicleFlag>{VehicleFlag::kNone, FlagDemand::kNothing},
    FlagRow<VehicleFlag>{VehicleFlag::kDefender, FlagDemand::kNothing},
    FlagRow<VehicleFlag>{VehicleFlag::kAttacker, FlagDemand::kNothing}};

// What is no flag at all counts as the first row.
template <class Flag, std::size_t N>
constexpr const FlagRow<Flag>& strictest_of(const std::array<FlagRow<Flag>, N>& table, Flag a,
                                            Flag b) {
  for (const FlagRow<Flag>& row : table)
    if (row.flag == a || row.flag == b) return row;
  return table[0];
}
constexpr TrackFlag more_restrictive(TrackFlag a, TrackFlag b) {
  return strictest_of(kTrackFlagTable, a, b).flag;
}
constexpr VehicleFlag more_restrictive(VehicleFlag a, VehicleFlag b) {
  return strictest_of(kVehicleFlagTable, a, b).flag;
}
constexpr FlagDemand demand_of(TrackFlag flag) {
  return strictest_of(kTrackFlagTable, flag, flag).demand;
}
constexpr FlagDemand demand_of(VehicleFlag flag) {
  return strictest_of(kVehicleFlagTable, flag, flag).demand;
}
constexpr FlagDemand demand_of(TrackFlag track, VehicleFlag vehicle) {
  return std::max(demand_of(track), demand_of(vehicle));
}

enum class FlagEncoding : std::uint8_t { kMyLaps, kMarelli };

struct RaceControl {
  TrackFlag track = TrackFlag::kNone;
  VehicleFlag vehicle = VehicleFlag::kNone;
  double round_target_speed_mps = kUnset;
  std::uint8_t raw_track = 0, raw_vehicle = 0, raw_sector = 0;  // for the acknowledgement
  FlagEncoding encoding = FlagEncoding::kMyLaps;
  bool ever_received = false;
  Instant last_heartbeat_change{};  // sign of life; reception alone is none
  std::uint8_t lap_count = 0;
  // The same of the other encoding, which is acknowledged too.
  std::uint8_t other_raw_track = 0, other_raw_vehicle = 0, other_raw_sector = 0;
  bool conflict = false;              // two sources contradict each other
  double refused_speed_mps = kUnset;  // a round speed above what the car's file allows
};

}  // namespace pitwall::world
