// Tables of the raw flag values of both race-control encodings. The encodings differ (value 1 is
// red in one and green in the other, 4 is green in one and chequered in the other), so each has its
// own table and no constant is shared.
//   in     the raw field of base_to_car_summary (MyLaps, 4 bits) or marelli_report_1 (8 bits)
//   out    typed flags; a value that is not in the table is kUnknown, which means "stop"
//   source flags as in the public code of the IAC teams; a value on which two teams disagree is
//          left out (MyLaps vehicle 1: "null" in one, "chequered" in another)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/race_control.hpp"

namespace pitwall::gateway {

struct TrackFlagRow {
  std::uint8_t raw;
  world::TrackFlag flag;
};
struct VehicleFlagRow {
  std::uint8_t raw;
  world::VehicleFlag flag;
};

inline constexpr std::array kMyLapsTrack{
    TrackFlagRow{0, world::TrackFlag::kNone},   TrackFlagRow{1, world::TrackFlag::kRed},
    TrackFlagRow{2, world::TrackFlag::kOrange}, TrackFlagRow{3, world::TrackFlag::kYellow},
    TrackFlagRow{4, world::TrackFlag::kGreen},  TrackFlagRow{8, world::TrackFlag::kWavingGreen}};

inline constexpr std::array kMyLapsVehicle{VehicleFlagRow{0, world::VehicleFlag::kNone},
                                           VehicleFlagRow{2, world::VehicleFlag::kBlackPitIn},
                                           VehicleFlagRow{4, world::VehicleFlag::kChequered},
                                           VehicleFlagRow{5, world::VehicleFlag::kDefender},
                                           VehicleFlagRow{7, world::VehicleFlag::kAttacker},
                                           VehicleFlagRow{8, world::VehicleFlag::kPurpleEmergency}};

inline constexpr std::array kMarelliTrack{
    TrackFlagRow{0, world::TrackFlag::kNone},   TrackFlagRow{1, world::TrackFlag::kGreen},
    TrackFlagRow{3, world::TrackFlag::kRed},    TrackFlagRow{4, world::TrackFlag::kChequered},
    TrackFlagRow{9, world::TrackFlag::kYellow}, TrackFlagRow{37, world::TrackFlag::kWavingGreen}};

inline constexpr std::array kMarelliVehicle{
    VehicleFlagRow{0, world::VehicleFlag::kNone},
    VehicleFlagRow{2, world::VehicleFlag::kBlue},
    VehicleFlagRow{4, world::VehicleFlag::kBlackPitIn},
    VehicleFlagRow{7, world::VehicleFlag::kYellow},
    VehicleFlagRow{25, world::VehicleFlag::kOrangeStartEngine},
    VehicleFlagRow{32, world::VehicleFlag::kPurpleEmergency},
    VehicleFlagRow{33, world::VehicleFlag::kEngineKill},
    VehicleFlagRow{34, world::VehicleFlag::kStop},
    VehicleFlagRow{35, world::VehicleFlag::kDefender},
    VehicleFlagRow{36, world::VehicleFlag::kAttacker}};

// Marelli's "GSpeed": green with a round speed; the value is the speed in mph. Known values are 40,
// 60, 80, 100 and 120 to 190 in steps of 5 mph.
constexpr bool is_green_speed(std::uint8_t raw) {
  const bool low = raw == 40 || raw == 60 || raw == 80 || raw == 100;
  return low || (raw >= 120 && raw <= 190 && raw % 5 == 0);
}

struct TrackMeaning {
  world::TrackFlag flag = world::TrackFlag::kUnknown;
  double round_target_speed_mps = kUnset;  // set by a Marelli green speed only
};

constexpr TrackMeaning track_meaning(world::FlagEncoding encoding, std::uint8_t raw) {
  if (encoding == world::FlagEncoding::kMyLaps) {
    for (const TrackFlagRow& row : kMyLapsTrack)
      if (row.raw == raw) return {row.flag};
    return {};
  }
  if (is_green_speed(raw)) return {world::TrackFlag::kGreen, from_mph(raw)};
  for (const TrackFlagRow& row : kMarelliTrack)
    if (row.raw == raw) return {row.flag};
  return {};
}

constexpr world::VehicleFlag vehicle_meaning(world::FlagEncoding encoding, std::uint8_t raw) {
  if (encoding == world::FlagEncoding::kMyLaps) {
    for (const VehicleFlagRow& row : kMyLapsVehicle)
      if (row.raw == raw) return row.flag;
    return world::VehicleFlag::kUnknown;
  }
  for (const VehicleFlagRow& row : kMarelliVehicle)
    if (row.raw == raw) return row.flag;
  return world::VehicleFlag::kUnknown;
}

static_assert(track_meaning(world::FlagEncoding::kMyLaps, 1).flag == world::TrackFlag::kRed);
static_assert(track_meaning(world::FlagEncoding::kMarelli, 1).flag == world::TrackFlag::kGreen);

}  // namespace pitwall::gateway
