// Telemetry registry: all fields that are sent over the radio as state, in one table. Codec, views
// and documents are derived from it; a field is added in its rows_*.hpp and nowhere else.
//   order  by group, in the order of Group; inside a group the order on the wire
//   errors a name that is not in the table does not compile
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <tuple>

#include "protocol/telemetry/registry/rows.hpp"
#include "protocol/telemetry/registry/rows_autonomy.hpp"
#include "protocol/telemetry/registry/rows_chassis.hpp"
#include "protocol/telemetry/registry/rows_health.hpp"
#include "protocol/telemetry/registry/rows_motion.hpp"
#include "protocol/telemetry/registry/rows_safety.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::telemetry {

namespace detail {

template <class... Rows>
constexpr auto one_table(const Rows&... rows) {
  std::array<FieldRow, (std::tuple_size_v<Rows> + ...)> table{};
  std::size_t at = 0;
  const auto append = [&](const auto& part) {
    for (const FieldRow& row : part) table[at++] = row;
  };
  (append(rows), ...);
  return table;
}

}  // namespace detail

inline constexpr auto kFields = detail::one_table(
    rows::kSafetyDown, rows::kMotionRows, rows::kChassisRows, rows::kLocalizationRows,
    rows::kOpponent1, rows::kOpponent2, rows::kOpponent3, rows::kOpponent4, rows::kRivalRows,
    rows::kPlannerRows, rows::kStreamRows, rows::kSensorRows, rows::kGnss0, rows::kGnss1,
    rows::kReceiverRows, rows::kHealthRows, rows::kSafetyUp);
inline constexpr std::size_t kFieldCount = kFields.size();

using FieldIndex = std::size_t;

// Index in the table of a field such as "ego.x"; an unknown name does not compile.
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

// One number per field in the unit of its row; NaN for an unknown value.
struct Values {
  std::array<double, kFieldCount> at = [] {
    std::array<double, kFieldCount> unset{};
    unset.fill(kUnset);
    return unset;
  }();

  constexpr double& operator[](FieldIndex i) { return at[i]; }
  constexpr double operator[](FieldIndex i) const { return at[i]; }
};

inline constexpr Instant kNeverSampled{std::numeric_limits<std::int64_t>::min()};

// Snapshot of one end's own state: the value of each field and the sample time of each group, on
// the clock of that end. A packet is made from the newest snapshot at the moment of sending.
struct Snapshot {
  Values values;
  std::array<Instant, kGroups> sampled_at = [] {
    std::array<Instant, kGroups> never{};
    never.fill(kNeverSampled);
    return never;
  }();

  constexpr Instant& at(Group g) { return sampled_at[index_of(g)]; }
  constexpr Instant at(Group g) const { return sampled_at[index_of(g)]; }
  constexpr bool ever(Group g) const { return at(g) != kNeverSampled; }
};

// Range of a group's fields in the table.
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

// Bits of a group's values on the wire; the size does not depend on the values.
inline constexpr auto kGroupBits = [] {
  std::array<std::size_t, kGroups> bits{};
  for (const FieldRow& row : kFields) bits[index_of(row.group)] += row.quantized().bits();
  return bits;
}();
constexpr std::size_t group_bits(Group group) { return kGroupBits[index_of(group)]; }

constexpr std::size_t bits_of(GroupSet set) {
  std::size_t bits = 0;
  for (const GroupRow& row : kGroupTable)
    if (set.has(row.group)) bits += group_bits(row.group);
  return bits;
}
constexpr std::size_t bytes_of(GroupSet set) { return (bits_of(set) + 7) / 8; }

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
      for (const FieldRow& row : kFields) {
        if (row.name.empty() || row.name.find(' ') != std::string_view::npos ||
            row.unit.find(' ') != std::string_view::npos || row.labels.ends_with('|'))
          return false;
      }
      return true;
    }(),
    "names and units are single words, and the last value has a label");
static_assert(
    [] {
      for (std::size_t i = 1; i < kFieldCount; ++i) {
        if (kFields[i].group < kFields[i - 1].group) return false;
      }
      return true;
    }(),
    "fields of a group stand together, groups in order");

}  // namespace pitwall::telemetry
