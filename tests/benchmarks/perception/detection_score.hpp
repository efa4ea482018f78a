// Detections of one sweep against what is true, and the sums over many.
//   in     true boxes with their number of returns, detected boxes, both in Body
//   out    by distance: cars, found ones, errors of position and direction; false detections
//   law    pairs by the least distance first, within kPair_m; each in one pair at most. A car with
//          fewer than kReturnsLeast returns is not asked for, and its detection is not false
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "hil/sensors/lidar/random_scene.hpp"
#include "vehicle/autonomy/perception/lidar/car_box.hpp"

namespace pitwall::perception_bench {

inline constexpr double kPair_m = 2.5;
inline constexpr std::size_t kReturnsLeast = 5;
inline constexpr std::array kRanges_m{0.0, 20.0, 40.0, 60.0, 80.0, 100.0, 120.0};
inline constexpr std::size_t kRanges = kRanges_m.size() - 1;

struct RangeScore {
  std::size_t cars = 0, found = 0;
  double squares_m2 = 0.0, yaw_squares_rad2 = 0.0, worst_m = 0.0;

  double found_share() const { return static_cast<double>(found) / static_cast<double>(cars); }
  double position_rms_m() const { return std::sqrt(squares_m2 / static_cast<double>(found)); }
  double yaw_rms_rad() const { return std::sqrt(yaw_squares_rad2 / static_cast<double>(found)); }
};

struct DetectionScore {
  std::array<RangeScore, kRanges> by_range{};
  std::size_t sweeps = 0, false_cars = 0;

  double false_per_sweep() const {
    return static_cast<double>(false_cars) / static_cast<double>(sweeps);
  }
  // Of all cars between two bounds of kRanges_m.
  RangeScore between(double from_m, double to_m) const;
  void add(const DetectionScore& other);
};

void score(std::span<const sensors::TrueBox> cars, std::span<const perception::CarBox> found,
           DetectionScore& sums);

}  // namespace pitwall::perception_bench
