// One row of the telemetry registry: what a number means and how it is written on the air.
//   units  min, max and resolution in the unit of the field; angles in radians
//   wire   as bits::Quantized has it; all ones is "unset"
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "protocol/bits/quantized.hpp"
#include "protocol/telemetry/registry/group_row.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

struct FieldRow {
  Group group;
  std::string_view name;
  std::string_view unit;
  double min, max, resolution;
  Class priority;
  Duration target_age;           // older than this at the base is late
  std::string_view labels = {};  // of the values 0, 1, 2 ...: "off|on"; empty: a number

  constexpr bits::Quantized quantized() const { return {min, max, resolution}; }
};

}  // namespace pitwall::telemetry
