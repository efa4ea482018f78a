// Set of the sensors that the operator has excluded, as an absolute bit set.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace pitwall::world {

enum class Excludable : std::uint8_t {
  kGnss0,  // positions, velocities and headings of the unit
  kGnss1,
  kImu0,
  kImu1,
  kWheels
};
inline constexpr std::size_t kExcludables = 5;

struct SensorUse {
  std::uint8_t excluded = 0;  // bit k: Excludable k

  constexpr bool uses(Excludable sensor) const {
    return (excluded >> static_cast<unsigned>(sensor) & 1U) == 0;
  }
  constexpr bool operator==(const SensorUse&) const = default;
};

}  // namespace pitwall::world
