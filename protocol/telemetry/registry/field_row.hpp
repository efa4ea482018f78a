// Row of the telemetry registry: meaning and wire encoding of one field.
//   units  min, max and resolution in the unit of the field; angles in radians
//   wire   as in bits::Quantized; all ones is "unset"
//   kind   a field without a unit, or a bit set, of resolution 1 is an integer or an enumeration;
//          one with the labels "no|yes" is a boolean; any other is real
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "protocol/bits/quantized.hpp"
#include "protocol/telemetry/registry/group_row.hpp"
#include "protocol/telemetry/registry/labels.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

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
