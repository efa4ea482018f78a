// Demands of race control, in one typed form whichever encoding the track uses (MyLaps or Marelli;
// value 1 is red in one and green in the other). A value that no table knows is kUnknown and is
// treated as kRed: never "keep racing".
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
  std::uint8_t raw_track = 0, raw_vehicle = 0, raw_sector = 0;  // to echo in the acknowledgement
  FlagEncoding encoding = FlagEncoding::kMyLaps;
  bool ever_received = false;
  Instant last_heartbeat_change{};  // liveness is a change of the heartbeat, not mere reception
  std::uint8_t lap_count = 0;
  // The same of the encoding that is not authoritative, which is acknowledged too.
  std::uint8_t other_raw_track = 0, other_raw_vehicle = 0, other_raw_sector = 0;
  bool conflict = false;  // both encodings are heard and mean different things
};

}  // namespace pitwall::world
