// Assignment of random streams to sensors: each sensor draws from its own stream only.
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

// Streams that belong to no unit.
inline constexpr std::uint64_t kSkyStream = 1000;  // GNSS errors common to both units
inline constexpr std::uint64_t kWheelStream = 1001;
inline constexpr std::uint64_t kDetectionStream = 1100;       // and the place of the sensor
inline constexpr std::uint64_t kDetectionFaultStream = 1200;  // and the place of the sensor

}  // namespace pitwall::sensors
