// The path that the car means to drive, as a bulk object: points and speeds on the map.
//   wire   version u8 (1), count u16; of the first point x and y i32 [cm], of each later one the
//          differences i16 [cm]; after x and y of each point its speed u16 [cm/s]. Little endian
//   in     points at most kPathStep apart; any bytes at all
//   invariants
//          |decoded - given| <= 0.5 cm and 0.5 cm/s: differences are of what was written, so no
//          error adds up
//   errors encode: none where a point is not finite, off the map or too far from the one before;
//          decode: none for any other bytes
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

// The result lies in `buffer`.
std::optional<std::span<const std::uint8_t>> encode_path(std::span<const PathPoint> points,
                                                         PathBuffer& buffer);
std::optional<Path> decode_path(std::span<const std::uint8_t> bytes);

}  // namespace pitwall::telemetry
