// One row of the telemetry registry: what a number means and how it is written on the air.
//   units  min, max and resolution in the unit of the field; angles in radians
//   wire   round((value - min) / resolution) in the fewest bits that also leave room for the code
//          "unset", which is all ones
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>

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
  kComputer
};
inline constexpr std::size_t kGroups = 12;
inline constexpr std::string_view kGroupNames[kGroups] = {
    "mode",   "flags", "ego",    "track",    "command", "feedback",
    "wheels", "tyres", "engine", "electric", "bus",     "computer"};

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

  constexpr std::uint64_t steps() const {
    return static_cast<std::uint64_t>((max - min) / resolution + 0.5);
  }
  // steps() + 1 values and the unset code.
  constexpr unsigned bits() const { return static_cast<unsigned>(std::bit_width(steps() + 1)); }
  constexpr std::uint64_t unset_code() const { return (std::uint64_t{1} << bits()) - 1; }
};

}  // namespace pitwall::telemetry
