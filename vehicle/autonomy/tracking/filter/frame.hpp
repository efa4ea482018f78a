// Detection frame as the filters use it: checked, with our own motion at the time of the frame.
//   frames our own pose in Map; measurements as in world/detection.hpp (Body at that time)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/detection.hpp"

namespace pitwall::tracking {

// Order of the frames: by the time of the measurement; the sensor decides between equal times.
struct FrameKey {
  Instant at{};
  world::DetectionSource source = world::DetectionSource::kLidar;
  std::uint8_t unit = 0;

  constexpr auto operator<=>(const FrameKey&) const = default;
};

// Our own car at the time of a frame.
struct OwnMotion {
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset;
  double vx_mps = kUnset, vy_mps = kUnset;  // Map, of the centre of gravity
  double s_m = kUnset;                      // station; unset without a map
};

// One detection. `value` by source: kLidar x, y, yaw, length, width (the last three may be unset);
// kCamera bearing, inverse depth, standard deviation of the bearing and, as a share, of the
// distance (the last three may be unset); kRadar range, bearing, range rate (may be unset).
struct Measurement {
  std::array<double, 5> value{kUnset, kUnset, kUnset, kUnset, kUnset};
  double confidence = kUnset;
};

struct Frame {
  FrameKey key;
  OwnMotion own;
  std::span<const Measurement> measurements;
};

inline constexpr std::size_t kMeasurementsMax = world::kDetectionsMax;  // of a frame

}  // namespace pitwall::tracking
