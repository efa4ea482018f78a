// Inputs of the alarm evaluator beside the vehicle state: figures of the link and of the base
// itself, and entries of operators. Plain values; their sources pass them on with the time of the
// change.
//   units  as in the names; kUnset if not known
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "basestation/state/station_field.hpp"
#include "basestation/state/vehicle_state.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::state {

struct LinkFigures {
  std::optional<Instant> received;              // the car's newest authentic packet
  double down_loss = kUnset, up_loss = kUnset;  // of the last 5 s, 0 .. 1; on all paths
  double round_trip_ms = kUnset, jitter_ms = kUnset;
  double loss_1s = kUnset, loss_30s = kUnset, packets_hz = kUnset;
  double down_kbit_s = kUnset, down_cap_kbit_s = kUnset, up_kbit_s = kUnset;
  double threats = kUnset;  // detected by the base: bits of telemetry::ThreatSet
};

struct BaseFigures {
  double disk_minutes = kUnset;  // recording time left on the disk
  double recording = kUnset;     // as kRecordingStates
  double recorder_lost = kUnset, recorder_kbyte_s = kUnset;
  double clock_offset_ms = kUnset;   // of the base against UTC, if something measures it
  bool joystick_lost = false;        // the device is gone, or silent with its key held
  bool authority_lost = false;       // expired without being dropped or handed over
  bool schema_differs = false;       // car and base disagree on the safety groups
  bool settings_unreadable = false;  // the file of limits and alarms exists but cannot be read
};

// Entries of operators at the pit wall.
struct Expectations {
  double round_speed_mps = kUnset;  // of the bracket that was announced
  double track_flag = kUnset;       // that the base relays, as telemetry::kTrackFlags
  double fuel_loaded_l = kUnset;    // in the tank when it was entered
  double fuel_used_l = 0.0;         // of them, when the entry was restored
  std::uint64_t fuel_entries = 0;   // number of entries, also of the same litres
};

struct Known {
  LinkFigures link;
  BaseFigures base;
  Expectations expected;
};

using BaseViews = std::array<FieldView, kBaseFields>;

}  // namespace pitwall::state
