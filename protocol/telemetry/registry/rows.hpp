// Rows of the telemetry registry: the table of its groups, and the row of a field. A group holds
// fields that are sampled and sent together and share one sample age. It is written whole or not at
// all, so that each packet with the group replaces all of its former values.
//   units  min, max and resolution in the unit of the field; angles in radians
//   wire   as in bits::Quantized; all ones is "unset"
//   kind   a field without a unit, or a bit set, of resolution 1 is an integer or an enumeration;
//          one with the labels "no|yes" is a boolean; any other is real
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "protocol/bits/quantized.hpp"
#include "protocol/telemetry/registry/labels.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

// ---- Groups

// Car to base, or base to car.
enum class Direction : std::uint8_t { kDown, kUp };

enum class Group : std::uint8_t {
  kMode,
  kFlags,
  kUplink,
  kEgo,
  kTrack,
  kCommand,
  kFeedback,
  kWheels,
  kDynamics,
  kSuspension,
  kTyres,
  kTread,
  kEngine,
  kPowertrain,
  kFuel,
  kElectric,
  kSteeringUnit,
  kBrakes,
  kLocalization,
  kOpponent1,
  kOpponent2,
  kOpponent3,
  kOpponent4,
  kRival,
  kPlanner,
  kStreams,
  kSensors,
  kGnss0,
  kGnss1,
  kReceivers,
  kComputer,
  kFaults,
  kBus,
  kRadio,
  kStop,      // up: the latched stop of the operator
  kJoystick,  // up: samples of the joystick with its dead-man's switch
  kAuthority  // up: the console that may send commands
};
inline constexpr std::size_t kGroups = 37;

constexpr std::size_t index_of(Group group) { return static_cast<std::size_t>(group); }

// Priority of a group when a packet has no room for all groups; the first has the highest.
enum class Class : std::uint8_t { kSafety, kMotion, kHealth, kStatistics };
inline constexpr std::size_t kClasses = 4;

struct GroupRow {
  Group group;
  std::string_view name;
  Direction direction;
  Class priority;       // kSafety: in every packet, paid from the reserved share
  Duration target_age;  // T_g of the scheduler
  double weight;        // w_g of the scheduler, > 0
};

// Target ages: a fast group is in nearly every packet of 50 Hz; a health group follows its sensor
// (the AV-21 sends engine and tyres at 10 Hz and slower); statistics need at most one per second.

inline constexpr auto kGroupTable = [] {
  using enum Group;
  using enum Class;
  constexpr auto kDown = Direction::kDown, kUp = Direction::kUp;
  return std::to_array<GroupRow>({
      {kMode, "mode", kDown, kSafety, milliseconds(100), 8.0},
      {kFlags, "flags", kDown, kSafety, milliseconds(100), 8.0},
      {kUplink, "uplink", kDown, kSafety, milliseconds(100), 8.0},
      {kEgo, "ego", kDown, kMotion, milliseconds(100), 4.0},
      {kTrack, "track", kDown, kMotion, milliseconds(150), 3.0},
      {kCommand, "command", kDown, kMotion, milliseconds(150), 3.0},
      {kFeedback, "feedback", kDown, kMotion, milliseconds(150), 3.0},
      {kWheels, "wheels", kDown, kMotion, milliseconds(150), 2.0},
      {kDynamics, "dynamics", kDown, kMotion, milliseconds(150), 2.0},
      {kSuspension, "suspension", kDown, kHealth, milliseconds(250), 1.0},
      {kTyres, "tyres", kDown, kHealth, seconds(1), 1.0},
      {kTread, "tread", kDown, kHealth, seconds(2), 0.5},
      {kEngine, "engine", kDown, kHealth, milliseconds(500), 1.0},
      {kPowertrain, "powertrain", kDown, kHealth, milliseconds(500), 1.0},
      {kFuel, "fuel", kDown, kHealth, seconds(2), 0.5},
      {kElectric, "electric", kDown, kHealth, milliseconds(500), 1.0},
      {kSteeringUnit, "steering_unit", kDown, kHealth, milliseconds(500), 1.0},
      {kBrakes, "brakes", kDown, kHealth, milliseconds(500), 1.0},
      {kLocalization, "localization", kDown, kHealth, milliseconds(250), 1.5},
      {kOpponent1, "opponent_1", kDown, kMotion, milliseconds(150), 3.0},
      {kOpponent2, "opponent_2", kDown, kMotion, milliseconds(150), 2.0},
      {kOpponent3, "opponent_3", kDown, kMotion, milliseconds(250), 1.0},
      {kOpponent4, "opponent_4", kDown, kMotion, milliseconds(250), 1.0},
      {kRival, "rival", kDown, kHealth, milliseconds(500), 1.0},
      {kPlanner, "planner", kDown, kMotion, milliseconds(150), 2.0},
      {kStreams, "streams", kDown, kHealth, milliseconds(250), 1.5},
      {kSensors, "sensors", kDown, kStatistics, seconds(1), 0.5},
      {kGnss0, "gnss0", kDown, kHealth, milliseconds(500), 1.0},
      {kGnss1, "gnss1", kDown, kHealth, milliseconds(500), 1.0},
      {kReceivers, "receivers", kDown, kStatistics, seconds(2), 0.5},
      {kComputer, "computer", kDown, kStatistics, seconds(1), 1.0},
      {kFaults, "faults", kDown, kHealth, milliseconds(250), 1.5},
      {kBus, "bus", kDown, kStatistics, seconds(1), 1.0},
      {kRadio, "radio", kDown, kHealth, milliseconds(500), 1.0},
      {kStop, "stop", kUp, kSafety, milliseconds(100), 8.0},
      {kJoystick, "joystick", kUp, kSafety, milliseconds(100), 8.0},
      {kAuthority, "authority", kUp, kSafety, milliseconds(100), 8.0},
  });
}();
static_assert(kGroupTable.size() == kGroups);
static_assert([] {
  for (std::size_t i = 0; i < kGroups; ++i)
    if (index_of(kGroupTable[i].group) != i || !(kGroupTable[i].weight > 0)) return false;
  return true;
}());

constexpr const GroupRow& row_of(Group group) { return kGroupTable[index_of(group)]; }

// Set of groups, one bit each in the order of Group.
struct GroupSet {
  std::uint64_t bits = 0;

  constexpr bool has(Group g) const { return (bits >> index_of(g) & 1U) != 0; }
  constexpr void add(Group g) { bits |= std::uint64_t{1} << index_of(g); }
  constexpr void remove(Group g) { bits &= ~(std::uint64_t{1} << index_of(g)); }
  constexpr bool empty() const { return bits == 0; }
  constexpr std::size_t count() const { return static_cast<std::size_t>(std::popcount(bits)); }
  constexpr bool operator==(const GroupSet&) const = default;
};
static_assert(kGroups <= 64);

constexpr GroupSet groups_of(Direction direction) {
  GroupSet set;
  for (const GroupRow& row : kGroupTable)
    if (row.direction == direction) set.add(row.group);
  return set;
}
constexpr GroupSet groups_of(Direction direction, Class priority) {
  GroupSet set;
  for (const GroupRow& row : kGroupTable)
    if (row.direction == direction && row.priority == priority) set.add(row.group);
  return set;
}

// ---- Fields

enum class FieldKind : std::uint8_t { kReal, kInteger, kYesNo };

struct FieldRow {
  Group group;
  std::string_view name;
  std::string_view unit;
  double min, max, resolution;
  std::string_view labels = {};  // of the values 0, 1, 2 ...: "off|on"; for a bit set, of its bits

  constexpr bits::Quantized quantized() const { return {min, max, resolution}; }
  constexpr FieldKind kind() const {
    if (labels == kNoYes) return FieldKind::kYesNo;
    const bool bare = unit.empty() || unit == kBitSet;
    return bare && resolution == 1.0 ? FieldKind::kInteger : FieldKind::kReal;
  }
  // Properties of the group, whose fields are always sent together.
  constexpr Class priority() const { return row_of(group).priority; }
  constexpr Duration target_age() const { return row_of(group).target_age; }

  static constexpr std::string_view kBitSet = "bits";
};

namespace rows {

// Rows that several groups use.
constexpr FieldRow count(Group group, std::string_view name, double max = 16'777'213.0) {
  return {group, name, "", 0, max, 1};  // 24 bits: 46 h at 100 Hz
}
constexpr FieldRow large_count(Group group, std::string_view name) {
  return count(group, name, 4'294'967'293.0);  // 32 bits
}
constexpr FieldRow choice(Group group, std::string_view name, std::string_view labels, double max) {
  return {group, name, "", 0, max, 1, labels};
}
constexpr FieldRow yes_no(Group group, std::string_view name) {
  return {group, name, "", 0, 1, 1, kNoYes};
}
constexpr FieldRow share(Group group, std::string_view name) {
  return {group, name, "", 0, 1, 0.004};  // 8 bits
}
constexpr FieldRow speed(Group group, std::string_view name) {
  return {group, name, "m/s", 0, 102, 0.05};
}

}  // namespace rows
}  // namespace pitwall::telemetry
