// The telemetry registry: every field that the car reports, in one table. Codec, views and
// documents are derived from it; a field is added here and nowhere else.
//   frames ego: Map and Body (ISO 8855) as in vehicle/world/ego_state.hpp; track offset left
//          positive; steering at the road wheel, left positive
//   errors a name that is not in the table does not compile
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "protocol/telemetry/registry/field_row.hpp"
#include "protocol/telemetry/registry/labels.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::telemetry {

namespace detail {

inline constexpr Duration kFast = milliseconds(150), kMedium = milliseconds(500),
                          kSlow = seconds(2);
inline constexpr double kCountMax = 4'294'967'293.0;  // 32 bits with the unset code
constexpr FieldRow count(Group group, std::string_view name) {
  return {group, name, "", 0, kCountMax, 1, Class::kStatistics, kSlow};
}
constexpr FieldRow speed(Group group, std::string_view name, Class priority) {
  return {group, name, "m/s", 0, 120, 0.02, priority, kFast};
}
constexpr FieldRow tyre(std::string_view name, std::string_view unit, double min, double max,
                        double resolution) {
  return {Group::kTyres, name, unit, min, max, resolution, Class::kHealth, kSlow};
}

}  // namespace detail

inline constexpr auto kFields = [] {
  using namespace detail;  // NOLINT: the table reads better without
  using enum Group;
  using enum Class;
  constexpr double kHalfTurn = 3.1416;
  return std::to_array<FieldRow>({
      {kMode, "mode", "", 0, 6, 1, kSafety, kFast, kModes},
      {kMode, "ct_state", "", 0, 255, 1, kSafety, kFast, kCtStates},
      {kMode, "sys_state", "", 0, 255, 1, kSafety, kFast, kSysStates},
      {kMode, "first_stop_cause", "", 0, 126, 1, kSafety, kFast, kStopCauses},
      {kMode, "arming", "", 0, 14, 1, kSafety, kMedium, kArmings},

      {kFlags, "track", "", 0, 14, 1, kSafety, kMedium, kTrackFlags},
      {kFlags, "vehicle", "", 0, 14, 1, kSafety, kMedium, kVehicleFlags},
      {kFlags, "round_target_speed", "m/s", 0, 120, 0.1, kSafety, kMedium},
      {kFlags, "heartbeat_age", "s", 0, 60, 0.01, kSafety, kMedium},

      {kEgo, "x", "m", -8'000, 8'000, 0.01, kMotion, kFast},
      {kEgo, "y", "m", -8'000, 8'000, 0.01, kMotion, kFast},
      {kEgo, "yaw", "rad", -kHalfTurn, kHalfTurn, 0.0002, kMotion, kFast},
      {kEgo, "vx", "m/s", -20, 120, 0.01, kMotion, kFast},
      {kEgo, "vy", "m/s", -30, 30, 0.01, kMotion, kFast},
      {kEgo, "yaw_rate", "rad/s", -4, 4, 0.001, kMotion, kFast},
      {kEgo, "position_sigma", "m", 0, 100, 0.005, kSafety, kFast},
      {kEgo, "validity", "", 0, 6, 1, kSafety, kFast, kValidities},

      {kTrack, "station", "m", 0, 16'000, 0.02, kMotion, kFast},
      {kTrack, "offset", "m", -60, 60, 0.01, kMotion, kFast},
      {kTrack, "lap", "", 0, 1'000, 1, kMotion, kSlow},
      {kTrack, "last_lap_time", "s", 0, 1'000, 0.001, kMotion, kSlow},
      speed(kTrack, "target_speed", kMotion),

      {kCommand, "steering", "rad", -0.6, 0.6, 0.0002, kMotion, kFast},
      {kCommand, "throttle", "", 0, 1, 0.002, kMotion, kFast},
      {kCommand, "brake", "kPa", 0, 8'000, 2, kMotion, kFast},
      {kCommand, "gear", "", 0, 14, 1, kMotion, kFast},

      {kFeedback, "steering", "rad", -0.6, 0.6, 0.0002, kMotion, kFast},
      {kFeedback, "throttle", "", 0, 1, 0.002, kMotion, kFast},
      {kFeedback, "brake_front", "kPa", 0, 14'000, 2, kMotion, kFast},
      {kFeedback, "brake_rear", "kPa", 0, 14'000, 2, kMotion, kFast},
      {kFeedback, "gear", "", 0, 14, 1, kMotion, kFast},

      speed(kWheels, "front_left", kMotion),
      speed(kWheels, "front_right", kMotion),
      speed(kWheels, "rear_left", kMotion),
      speed(kWheels, "rear_right", kMotion),

      tyre("temperature_front_left", "degC", -20, 200, 0.5),
      tyre("temperature_front_right", "degC", -20, 200, 0.5),
      tyre("temperature_rear_left", "degC", -20, 200, 0.5),
      tyre("temperature_rear_right", "degC", -20, 200, 0.5),
      tyre("pressure_front_left", "kPa", 0, 500, 0.5),
      tyre("pressure_front_right", "kPa", 0, 500, 0.5),
      tyre("pressure_rear_left", "kPa", 0, 500, 0.5),
      tyre("pressure_rear_right", "kPa", 0, 500, 0.5),

      {kEngine, "speed", "rpm", 0, 12'000, 5, kHealth, kFast},
      {kEngine, "running", "", 0, 2, 1, kHealth, kMedium, kNoYes},
      {kEngine, "fuel_pressure", "kPa", 0, 1'000, 1, kHealth, kSlow},
      {kEngine, "oil_pressure", "kPa", 0, 1'500, 1, kHealth, kSlow},
      {kEngine, "coolant", "degC", -40, 200, 0.5, kHealth, kSlow},

      {kElectric, "battery", "V", 0, 30, 0.02, kHealth, kSlow},
      {kElectric, "diagnostics", "bits", 0, 16'777'214, 1, kSafety, kMedium},

      count(kBus, "frames_applied"),
      count(kBus, "frames_refused"),
      count(kBus, "frames_sent"),
      count(kBus, "tx_drops"),
      count(kBus, "gate_refusals"),
      count(kBus, "frames_lost"),
      count(kBus, "queue_losses"),
      {kBus, "controller", "", 0, 6, 1, kSafety, kMedium, kControllerStates},
      {kBus, "identity", "", 0, 6, 1, kSafety, kMedium, kIdentities},
      {kBus, "differing_id", "", 0, 536'870'911, 1, kSafety, kSlow},
      count(kBus, "database"),

      {kComputer, "step_time_max", "us", 0, 1'000'000, 1, kStatistics, kSlow},
      count(kComputer, "steps"),
      count(kComputer, "missed_deadlines"),

      {kRadio, "base", "", 0, 6, 1, kSafety, kMedium, kBaseStates},
      {kRadio, "silence", "s", 0, 60, 0.01, kSafety, kMedium},
      {kRadio, "round_trip", "ms", 0, 10'000, 0.1, kStatistics, kSlow},
      count(kRadio, "heartbeats"),
      count(kRadio, "heartbeats_refused"),
      count(kRadio, "base_runs"),

      {kStop, "level", "", 0, 2, 1, kSafety, kFast, kStopLevels},
      {kStop, "epoch", "", 0, 253, 1, kSafety, kFast},
      {kStop, "reason", "", 0, 14, 1, kSafety, kFast, kStopReasons},

      {kJoystick, "active", "", 0, 2, 1, kSafety, kFast, kNoYes},
      {kJoystick, "sample", "", 0, 65'533, 1, kSafety, kFast},
      {kJoystick, "sample_age", "ms", 0, 1'000, 1, kSafety, kFast},
      {kJoystick, "throttle_cap", "", 0, 1, 0.005, kSafety, kFast},
      {kJoystick, "brake", "", 0, 1, 0.005, kSafety, kFast},

      {kAuthority, "holder", "", 0, 254, 1, kSafety, kFast},
      {kAuthority, "epoch", "", 0, 65'533, 1, kSafety, kFast},
      {kAuthority, "renewal", "", 0, 65'533, 1, kSafety, kFast},
  });
}();
inline constexpr std::size_t kFieldCount = kFields.size();

using FieldIndex = std::size_t;

// "ego.x" to its place in the table; anything else does not compile.
consteval FieldIndex field(std::string_view path) {
  for (FieldIndex i = 0; i < kFieldCount; ++i) {
    const std::string_view group = row_of(kFields[i].group).name;
    if (path.size() != group.size() + 1 + kFields[i].name.size()) continue;
    if (path.starts_with(group) && path[group.size()] == '.' && path.ends_with(kFields[i].name)) {
      return i;
    }
  }
  throw "no such field in the telemetry registry";  // reached only at compile time
}

// One number per field in the unit of its row; NaN where the car does not know.
struct Values {
  std::array<double, kFieldCount> at = [] {
    std::array<double, kFieldCount> unset{};
    unset.fill(kUnset);
    return unset;
  }();

  constexpr double& operator[](FieldIndex i) { return at[i]; }
  constexpr double operator[](FieldIndex i) const { return at[i]; }
};

// Where the fields of a group stand in the table.
struct FieldSpan {
  FieldIndex first = 0, count = 0;
};
inline constexpr auto kGroupFields = [] {
  std::array<FieldSpan, kGroups> spans{};
  for (FieldIndex i = 0; i < kFieldCount; ++i) {
    FieldSpan& span = spans[index_of(kFields[i].group)];
    if (span.count++ == 0) span.first = i;
  }
  return spans;
}();
constexpr FieldSpan fields_of(Group group) { return kGroupFields[index_of(group)]; }

// Bits of a group's values on the air; the same for every value.
inline constexpr auto kGroupBits = [] {
  std::array<std::size_t, kGroups> bits{};
  for (const FieldRow& row : kFields) bits[index_of(row.group)] += row.quantized().bits();
  return bits;
}();
constexpr std::size_t group_bits(Group group) { return kGroupBits[index_of(group)]; }

namespace detail {

constexpr std::uint32_t fnv1a(std::uint32_t hash, std::uint64_t word, int bytes) {
  for (int i = 0; i < bytes; ++i) {
    const auto byte = static_cast<std::uint8_t>(word >> (8 * i));
    hash = (hash ^ byte) * 16'777'619U;
  }
  return hash;
}
constexpr std::uint32_t fnv1a(std::uint32_t hash, std::string_view text) {
  for (const char c : text) hash = fnv1a(hash, static_cast<std::uint8_t>(c), 1);
  return fnv1a(hash, 0, 1);
}

}  // namespace detail

// Changes with anything that changes the meaning of a packet's bits. Two ends that differ in it
// refuse each other's packets and say so.
inline constexpr std::uint32_t kSchemaHash = [] {
  std::uint32_t hash = 2'166'136'261U;
  for (const FieldRow& row : kFields) {
    hash = detail::fnv1a(hash, row_of(row.group).name);
    hash = detail::fnv1a(hash, row.name);
    hash = detail::fnv1a(hash, row.unit);
    hash = detail::fnv1a(hash, row.labels);
    for (const double number : {row.min, row.max, row.resolution}) {
      hash = detail::fnv1a(hash, std::bit_cast<std::uint64_t>(number), 8);
    }
  }
  return hash;
}();

// Of all groups that the car tells.
inline constexpr std::size_t kValueBits = [] {
  std::size_t bits = 0;
  for (const GroupRow& row : kGroupTable)
    if (row.direction == Direction::kDown) bits += group_bits(row.group);
  return bits;
}();

static_assert(
    [] {
      for (const FieldRow& row : kFields) {
        if (!(row.min < row.max) || !(row.resolution > 0) || row.quantized().bits() > 32)
          return false;
      }
      return true;
    }(),
    "a row of the registry has no sensible range");
static_assert(
    [] {
      for (std::size_t i = 1; i < kFieldCount; ++i) {
        if (kFields[i].group < kFields[i - 1].group) return false;
      }
      return true;
    }(),
    "fields of a group stand together, groups in order");

}  // namespace pitwall::telemetry
