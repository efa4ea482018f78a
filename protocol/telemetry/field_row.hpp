// One row of the telemetry registry: what a number means and how it is written on the air.
//   units  min, max and resolution in the unit of the field; angles in radians
//   wire   as bits::Quantized has it; all ones is "unset"
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "protocol/bits/quantized.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

// Fields of one group are sampled together and share one sample age.
enum class Group : std::uint8_t {
  kMode,
  kFlags,
  kEgo,
  kTrack,
  kCommand,
  kFeedback,
  kWheels,
  kTyres,
  kEngine,
  kElectric,
  kBus,
  kComputer,
  kRadio
};
inline constexpr std::size_t kGroups = 13;
inline constexpr std::string_view kGroupNames[kGroups] = {
    "mode",  "flags",  "ego",      "track", "command",  "feedback", "wheels",
    "tyres", "engine", "electric", "bus",   "computer", "radio"};

// The part of the link that a field may claim when not all fits; first is kept longest.
enum class Class : std::uint8_t { kSafety, kMotion, kHealth, kStatistics };

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
