// Assignment of random streams to sensors: a sensor never draws from another's.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace pitwall::sensors {

enum class UnitStream : std::uint64_t {
  kPosition,
  kVelocity,
  kHeading,
  kImu,
  kInertialBias,
  kInertialSolution,
  kArrival,  // jitter and gaps
  kClaim     // of the reported sigmas
};
inline constexpr std::uint64_t kUnitStreams = 8;

constexpr std::uint64_t stream_of(std::size_t unit, UnitStream stream) {
  return unit * kUnitStreams + static_cast<std::uint64_t>(stream);
}

// Beside the units.
inline constexpr std::uint64_t kSkyStream = 1000;  // what both units see of the satellites
inline constexpr std::uint64_t kWheelStream = 1001;

}  // namespace pitwall::sensors
