// Demands of race control in one typed form for both encodings of the tracks (MyLaps or Marelli;
// value 1 is red in one and green in the other). A value that is not in a table is kUnknown and is
// treated as kRed, never as permission to race.
// SPDX-License-Identifier: Apache-2.0
#pragma once

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
  bool conflict = false;  // both encodings are received and contradict each other
};

}  // namespace pitwall::world
