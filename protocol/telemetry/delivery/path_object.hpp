// Codec of the planned path as a bulk object: points on the map with their speeds.
//   wire   version u8 (1), count u16; x and y of the first point as i32 [cm], of each later point
//          as difference i16 [cm]; after x and y of each point its speed u16 [cm/s]. Little endian
//   in     encode: 1 to kPathPoints points, at most kPathStep_m apart in x and in y; decode: any
//          bytes
//   invariants
//          |decoded - given| <= 0.5 cm and 0.5 cm/s: differences are taken between the rounded
//          points, so rounding errors do not add up
//   errors encode returns an empty optional if the number of points is out of range, or if a point
//          is not finite, beyond kPathReach_m, too fast or too far from the point before; decode
//          returns one for any bytes that encode does not write
//   cost   encode: no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::telemetry {

inline constexpr std::size_t kPathPoints = 128;
inline constexpr double kPathStep_m = 300.0, kPathReach_m = 1e6, kPathSpeed_mps = 600.0;

struct PathPoint {
  double x_m = kUnset, y_m = kUnset, speed_mps = kUnset;
};
using Path = FixedVector<PathPoint, kPathPoints>;

inline constexpr std::size_t kPathHead = 3, kPathFirst = 10, kPathLater = 6;
using PathBuffer =
    std::array<std::uint8_t, kPathHead + kPathFirst + (kPathPoints - 1) * kPathLater>;

// The result points into `buffer`.
std::optional<std::span<const std::uint8_t>> encode_path(std::span<const PathPoint> points,
                                                         PathBuffer& buffer);
std::optional<Path> decode_path(std::span<const std::uint8_t> bytes);

}  // namespace pitwall::telemetry
