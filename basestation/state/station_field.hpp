// Fields that the base itself computes: its link, values derived from the car's fields, its own
// health. Consoles show them like the car's: a value, an age, a quality, a judgement.
//   ids    a field of the radio's registry has its place there as id; the base's own follow from
//          kFirstBaseField on in the order of BaseField
//   units  as in each row; angles in radians
//   errors a path that is in neither table does not compile; find_field() returns nullopt for it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::state {

using FieldId = std::uint16_t;
inline constexpr FieldId kFirstBaseField = 16'384;

enum class BaseField : std::uint8_t {
  kLinkState,
  kLinkSilence,
  kDownLoss,
  kUpLoss,
  kRoundTrip,
  kJitter,
  kDownRate,
  kDownCap,
  kUpRate,
  kWorstAge,
  kLoss1s,
  kLoss30s,
  kPacketRate,
  kStaleGroups,
  kStop,
  kWatchdogsLate,
  kWatchdogsLost,
  kGnssGood,
  kCorrectionAge,
  kCorrectionConflict,
  kSlipRearFront,
  kSlipRearGnss,
  kSlip,
  kTyreMin,
  kTyreGate,
  kTyreMargin,
  kTyrePressureMin,
  kCrossTrack,
  kSensorShare,
  kSensorGap,
  kSensorLatency,
  kCameraOffset,
  kFlagConflict,
  kRoundSpeedConflict,
  kRaceControlSpeed,
  kFuelPerLap,
  kFuelLaps,
  kFuelAttempts,
  kFuelState,
  kCornerIn,
  kGhostX,
  kGhostY,
  kGhostYaw,
  kGhostRadius,
  kFuelLevel,
  kFuelEstimated,
  kFuelLeast,
  kFuelLeastLaps,
  kRoundSpeedExpected,
  kInPit,
  kDiskMinutes,
  kRecording,
  kRecorderLost,
  kRecorderRate,
  kClockOffset,
  kJoystickLost,
  kAuthorityLost,
  kSchemaDiffers,
  kSettingsUnreadable,
  kFlagRelayed,
  kRole,
  kRoleConflict,
  kAttempt,
  kAttemptState,
  kAttemptLaps,
  kAttemptLapsLeft,
  kGapAhead,
  kGapBehind,
  kGapClosing,
  kWrongKey,
  kModeMismatch,
  kRefusedAtRate,
  kSecondPeer,
  kReplayedOpenings,
  kRelay
};
inline constexpr std::size_t kBaseFields = 75;

struct BaseRow {
  BaseField field;
  std::string_view group, name, unit;
  double min, max, resolution;
  std::string_view labels = {};
};
inline constexpr Duration kBasePeriod = milliseconds(100);  // longest time between two computations

inline constexpr std::string_view kLinkStates = "none|good|degraded|lost";
inline constexpr std::string_view kRecordingStates = "off|on|disk takes nothing";
inline constexpr std::string_view kFuelStates = "unknown|enough|no attempt left|home now";

inline constexpr std::string_view kAttemptStates = "none|running|laps used up|PASSED|ended";
// Which end of the radio detects an attack or a key error.
inline constexpr std::string_view kSeenBy = "no|by the base|by the car|by both";

inline constexpr auto kBaseTable = [] {
  using enum BaseField;
  constexpr std::string_view kNoYes = telemetry::kNoYes;
  constexpr double kMetres = 100'000.0, kLong_ms = 1e9;
  return std::to_array<BaseRow>({
      {kLinkState, "link", "state", "", 0, 3, 1, kLinkStates},
      {kLinkSilence, "link", "silence_ms", "ms", 0, kLong_ms, 1},  // since the car's newest packet
      {kDownLoss, "link", "down_loss", "", 0, 1, 0.001},           // of the last 5 s
      {kUpLoss, "link", "up_loss", "", 0, 1, 0.001},
      {kRoundTrip, "link", "rtt_ms", "ms", 0, kLong_ms, 0.1},
      {kJitter, "link", "jitter_ms", "ms", 0, kLong_ms, 0.1},
      {kDownRate, "link", "down_kbit_s", "kbit/s", 0, kLong_ms, 0.1},
      {kDownCap, "link", "down_cap_kbit_s", "kbit/s", 0, kLong_ms, 0.1},
      {kUpRate, "link", "up_kbit_s", "kbit/s", 0, kLong_ms, 0.1},
      {kWorstAge, "link", "worst_age_ms", "ms", 0, kLong_ms, 1},  // of the groups in every packet
      {kLoss1s, "link", "loss_1s", "", 0, 1, 0.001},
      {kLoss30s, "link", "loss_30s", "", 0, 1, 0.001},
      {kPacketRate, "link", "rate_hz", "Hz", 0, 1'000, 0.1},
      {kStaleGroups, "link", "stale_groups", "", 0, 64, 1},
      {kStop, "derived", "stop", "", 0, 2, 1, telemetry::kStopLevels},  // latched or in progress
      {kWatchdogsLate, "derived", "watchdogs_late", "", 0, 64, 1},
      {kWatchdogsLost, "derived", "watchdogs_lost", "", 0, 64, 1},
      {kGnssGood, "derived", "gnss_good", "", 0, 2, 1},  // receivers good enough for driving
      {kCorrectionAge, "derived", "correction_age", "s", 0, 1'000, 0.5},  // of the fresher unit
      {kCorrectionConflict, "derived", "correction_conflict", "", 0, 1, 1, kNoYes},
      {kSlipRearFront, "derived", "slip_rear_front", "", -2, 2, 0.001},  // share of the speed
      {kSlipRearGnss, "derived", "slip_rear_gnss", "", -2, 2, 0.001},
      {kSlip, "derived", "slip", "", -2, 2, 0.001},  // the larger one; 0 below kSlipSpeed_mps
      {kTyreMin, "derived", "tyre_min", "degC", -40, 214, 1},
      {kTyreGate, "derived", "tyre_gate", "degC", -40, 214, 1},  // needed for the requested speed
      {kTyreMargin, "derived", "tyre_margin", "degC", -260, 260, 1},
      {kTyrePressureMin, "derived", "tyre_pressure_min", "kPa", 0, 408, 0.8},
      {kCrossTrack, "derived", "cross_track", "m", 0, 10, 0.02},
      {kSensorShare, "derived", "sensor_rate_share", "", 0, 2, 0.01},  // worst, of its nominal rate
      {kSensorGap, "derived", "sensor_gap_ms", "ms", 0, 1'016, 4},     // worst
      {kSensorLatency, "derived", "sensor_latency_share", "", 0, 10, 0.01},  // worst, of allowed
      {kCameraOffset, "derived", "camera_offset_share", "", 0, 20, 0.01},    // worst, of allowed
      {kFlagConflict, "derived", "flag_conflict", "", 0, 1, 1, kNoYes},
      {kRoundSpeedConflict, "derived", "round_speed_conflict", "", 0, 1, 1, kNoYes},
      {kRaceControlSpeed, "derived", "race_control_speed", "m/s", 0, 102, 0.1},
      {kFuelPerLap, "derived", "fuel_per_lap", "l", 0, 102, 0.01},
      {kFuelLaps, "derived", "fuel_laps", "", 0, 1'000, 0.1},
      {kFuelAttempts, "derived", "fuel_attempts", "", 0, 500, 1},  // with the lap into the pits
      {kFuelState, "derived", "fuel_state", "", 0, 3, 1, kFuelStates},
      {kCornerIn, "derived", "corner_in_s", "s", 0, 1'000, 0.1},  // 0: in one
      {kGhostX, "derived", "ghost_x", "m", -kMetres, kMetres, 0.1},
      {kGhostY, "derived", "ghost_y", "m", -kMetres, kMetres, 0.1},
      {kGhostYaw, "derived", "ghost_yaw", "rad", -3.1416, 3.1416, 0.001},
      {kGhostRadius, "derived", "ghost_radius", "m", 0, kMetres, 0.1},
      {kFuelLevel, "derived", "fuel_level", "l", 0, 200, 0.1},  // measured, otherwise estimated
      {kFuelEstimated, "derived", "fuel_estimated", "", 0, 1, 1, kNoYes},
      {kFuelLeast, "derived", "fuel_least", "l", 0, 200, 0.1},  // at the highest consumption
      {kFuelLeastLaps, "derived", "fuel_least_laps", "", 0, 1'000, 0.1},
      {kRoundSpeedExpected, "derived", "round_speed_expected", "m/s", 0, 102, 0.1},  // announced
      {kInPit, "derived", "in_pit", "", 0, 1, 1, kNoYes},
      {kDiskMinutes, "base", "disk_minutes", "min", 0, kLong_ms, 1},
      {kRecording, "base", "recording", "", 0, 2, 1, kRecordingStates},
      {kRecorderLost, "base", "recorder_lost", "", 0, 1e15, 1},  // records, since the start
      {kRecorderRate, "base", "recorder_kbyte_s", "kB/s", 0, 1e6, 0.1},
      {kClockOffset, "base", "clock_offset_ms", "ms", -kLong_ms, kLong_ms, 0.1},
      {kJoystickLost, "base", "joystick_lost", "", 0, 1, 1, kNoYes},
      {kAuthorityLost, "base", "authority_lost", "", 0, 1, 1, kNoYes},
      {kSchemaDiffers, "base", "schema_differs", "", 0, 1, 1, kNoYes},
      {kSettingsUnreadable, "base", "settings_unreadable", "", 0, 1, 1, kNoYes},
      // Track flag that the base relays.
      {kFlagRelayed, "derived", "flag_relayed", "", 0, 7, 1, telemetry::kTrackFlags},
      {kRole, "derived", "role", "", 0, 2, 1, telemetry::kRoles},  // from race control
      {kRoleConflict, "derived", "role_conflict", "", 0, 1, 1, kNoYes},
      {kAttempt, "derived", "attempt", "", 0, 1'000, 1},  // number; of the passing competition
      {kAttemptState, "derived", "attempt_state", "", 0, 4, 1, kAttemptStates},
      {kAttemptLaps, "derived", "attempt_laps", "", 0, 1'000, 0.01},  // driven in it
      {kAttemptLapsLeft, "derived", "attempt_laps_left", "", 0, 100, 0.01},
      {kGapAhead, "derived", "gap_ahead", "m", 0, 13'000, 0.1},  // bumper to bumper
      {kGapBehind, "derived", "gap_behind", "m", 0, 13'000, 0.1},
      {kGapClosing, "derived", "gap_closing", "m/s", -102, 102, 0.1},  // to the nearer car
      // In the order of telemetry::Threat.
      {kWrongKey, "link", "wrong_key", "", 0, 3, 1, kSeenBy},
      {kModeMismatch, "link", "mode_mismatch", "", 0, 3, 1, kSeenBy},
      {kRefusedAtRate, "link", "refused_at_rate", "", 0, 3, 1, kSeenBy},
      {kSecondPeer, "link", "second_peer", "", 0, 3, 1, kSeenBy},
      {kReplayedOpenings, "link", "replayed_openings", "", 0, 3, 1, kSeenBy},
      {kRelay, "link", "relay", "", 0, 3, 1, kSeenBy},
  });
}();
static_assert(kBaseTable.size() == kBaseFields);
static_assert([] {
  for (std::size_t i = 0; i < kBaseFields; ++i)
    if (static_cast<std::size_t>(kBaseTable[i].field) != i) return false;
  return true;
}());

constexpr std::size_t index_of(BaseField field) { return static_cast<std::size_t>(field); }
constexpr const BaseRow& row_of(BaseField field) { return kBaseTable[index_of(field)]; }
constexpr FieldId id_of(BaseField field) {
  return static_cast<FieldId>(kFirstBaseField + index_of(field));
}
constexpr FieldId id_of(telemetry::FieldIndex field) { return static_cast<FieldId>(field); }
constexpr bool is_base(FieldId id) {
  return id >= kFirstBaseField && id < kFirstBaseField + kBaseFields;
}
constexpr bool is_field(FieldId id) { return is_base(id) || id < telemetry::kFieldCount; }
constexpr BaseField base_field(FieldId id) { return static_cast<BaseField>(id - kFirstBaseField); }

// "tyres.pressure_rear_left" or "derived.slip".
constexpr std::optional<FieldId> find_field(std::string_view path) {
  const auto is = [path](std::string_view group, std::string_view name) {
    return path.size() == group.size() + 1 + name.size() && path.starts_with(group) &&
           path[group.size()] == '.' && path.ends_with(name);
  };
  for (std::size_t i = 0; i < telemetry::kFieldCount; ++i) {
    const telemetry::FieldRow& row = telemetry::kFields[i];
    if (is(telemetry::row_of(row.group).name, row.name)) return id_of(i);
  }
  for (const BaseRow& row : kBaseTable) {
    if (is(row.group, row.name)) return id_of(row.field);
  }
  return std::nullopt;
}
consteval FieldId field_id(std::string_view path) {
  return find_field(path).value();  // throws for an unknown path, which then does not compile
}

// Path of an id; empty for an unknown one.
inline std::string path_of(FieldId id) {
  if (!is_field(id)) return {};
  const std::string_view group = is_base(id) ? row_of(base_field(id)).group
                                             : telemetry::row_of(telemetry::kFields[id].group).name;
  const std::string_view name =
      is_base(id) ? row_of(base_field(id)).name : telemetry::kFields[id].name;
  return std::string{group} + "." + std::string{name};
}

}  // namespace pitwall::state
