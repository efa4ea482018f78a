// Detections of other cars by the perception sensors, before tracking.
//   frames Body of our car (ISO 8855: x forward, y left, z up, origin at the centre of gravity) at
//          the time of the measurement
//   units  in the names; a value that the sensor does not measure is unset (NaN)
//   use    kLidar: position, yaw, size. kCamera: bearing, and inverse depth from the height of the
//          image. kRadar: range, bearing, range rate, with our own motion still in it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::world {

enum class DetectionSource : std::uint8_t { kLidar, kCamera, kRadar };
inline constexpr std::size_t kDetectionSources = 3;

struct Detection {
  double confidence = kUnset;         // [0, 1]
  double x_m = kUnset, y_m = kUnset;  // centre of the box
  double yaw_rad = kUnset;            // of the box; front and back may be exchanged
  double length_m = kUnset, width_m = kUnset;
  double bearing_rad = kUnset;          // counter-clockwise from the x axis
  double inverse_depth_per_m = kUnset;  // of the distance along the bearing
  // By which both may be off, where the detector knows (kCamera): standard deviations, that of the
  // distance as a share of it.
  double bearing_sigma_rad = kUnset, distance_sigma = kUnset;
  double range_m = kUnset;
  double range_rate_mps = kUnset;  // positive while the distance grows
};

inline constexpr std::size_t kDetectionsMax = 24;  // of one frame

// One sweep, image or scan. An empty frame is a measurement too: nothing was seen.
struct DetectionFrame {
  DetectionSource source = DetectionSource::kLidar;
  std::uint8_t unit = 0;  // which sensor of that kind
  Instant at{};           // of the measurement, on the car's clock
  Instant received{};     // arrival at the car's computer
  FixedVector<Detection, kDetectionsMax> detections{};
};

// What a camera sees off, against the LiDARs, on the mean of many cars; unset where that is not
// known.
struct CameraBias {
  double bearing_rad = kUnset;     // its bearing less theirs
  double distance_ratio = kUnset;  // its distance over theirs
};
inline constexpr std::size_t kWatchedCameras = 2;  // units 0 and 1

}  // namespace pitwall::world
