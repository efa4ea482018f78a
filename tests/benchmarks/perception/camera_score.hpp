// Detections of one image against what is true, and the sums over many.
//   in     true cars that the image shows, with their number of pixels; a frame of detections
//   out    by distance: cars, found ones, errors of bearing and distance; false detections
//   law    pairs by the least difference of bearing first, within kPair_rad and kPairShare of the
//          distance; each in one pair at most. A car with fewer than kPixelsLeast pixels, or whose
//          middle is beyond the image, is not asked for, and its detection is not false
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "hil/sensors/camera/camera_scene.hpp"
#include "protocol/vocabulary/units.hpp"
#include "tests/benchmarks/cost/cost_gates.hpp"
#include "vehicle/world/detection.hpp"

namespace pitwall::perception_bench {

inline constexpr double kPair_rad = 0.03, kPairShare = 0.4;
inline constexpr std::size_t kPixelsLeast = 30;
inline constexpr std::array kCameraRanges_m{0.0, 20.0, 40.0, 60.0, 80.0, 100.0};
inline constexpr std::size_t kCameraRanges = kCameraRanges_m.size() - 1;

struct CameraRangeScore {
  std::size_t cars = 0, found = 0;
  double bearing_squares_rad2 = 0.0, share_squares = 0.0;  // of the distance

  double found_share() const { return static_cast<double>(found) / static_cast<double>(cars); }
  double bearing_rms_rad() const {
    return std::sqrt(bearing_squares_rad2 / static_cast<double>(found));
  }
  double distance_rms_share() const {
    return std::sqrt(share_squares / static_cast<double>(found));
  }
};

struct CameraScore {
  std::array<CameraRangeScore, kCameraRanges> by_range{};
  std::size_t images = 0, false_cars = 0;

  CameraRangeScore to(double most_m) const;  // a bound of kCameraRanges_m
  double false_per_image() const {
    return static_cast<double>(false_cars) / static_cast<double>(images);
  }
};

void score(const sensors::CameraScene& scene, const world::DetectionFrame& frame,
           CameraScore& sums);

// What the camera's network has to reach on images unlike those of its training: 0.95 found to
// 60 m, 0.90 to 100 m; 0.02 false ones an image; to 100 m the bearing to 3 mrad rms and the
// distance to 8 % rms.
void add_gates(const CameraScore& held_back, cost::CostGates& gates);
// Among decoys that it has not seen before: 0.04 false ones an image.
void add_decoy_gate(const CameraScore& among_decoys, cost::CostGates& gates);

std::string to_text(const std::string& set, const CameraScore& score);
std::string to_json(const std::string& set, const CameraScore& score);

}  // namespace pitwall::perception_bench
