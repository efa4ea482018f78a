// Mounting of an IMU in the car: the directions of the axes of its enclosure.
//   in     vectors in the axes of the enclosure
//   out    vectors in Body (ISO 8855: x forward, y left, z up)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::receivers {

enum class Axis : std::uint8_t { kPlusX, kMinusX, kPlusY, kMinusY, kPlusZ, kMinusZ };

// Axes of the enclosure that point forward, left and up.
struct Mounting {
  Axis forward = Axis::kPlusX, left = Axis::kPlusY, up = Axis::kPlusZ;
};

// NovAtel's vehicle frame: x right, y forward, z up.
inline constexpr Mounting kAsNovatel{Axis::kPlusY, Axis::kMinusX, Axis::kPlusZ};
// VectorNav's body frame: x forward, y right, z down.
inline constexpr Mounting kAsVectorNav{Axis::kPlusX, Axis::kMinusY, Axis::kMinusZ};

constexpr double along(Axis axis, const std::array<double, 3>& v) {
  switch (axis) {
    case Axis::kPlusX:
      return v[0];
    case Axis::kMinusX:
      return -v[0];
    case Axis::kPlusY:
      return v[1];
    case Axis::kMinusY:
      return -v[1];
    case Axis::kPlusZ:
      return v[2];
    case Axis::kMinusZ:
      return -v[2];
  }
  return kUnset;
}

constexpr std::array<double, 3> to_body(const Mounting& m, const std::array<double, 3>& v) {
  return {along(m.forward, v), along(m.left, v), along(m.up, v)};
}

}  // namespace pitwall::receivers
