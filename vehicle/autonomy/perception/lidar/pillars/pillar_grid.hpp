// What a network sees of a sweep: figures of each cell of the road that has points.
//   in     a merged cloud in Body at the reference time; the map's ground under it
//   out    pillars, by cell. Cells are rows along the track, from behind us to ahead, of columns
//          across it, from right to left of the reference line
//   law    what stands over the road is moved along it by `others_mps` for the time between its ray
//          and the reference: two cars in one place of the road look alike in any turn
//   cost   O(points): 4 ms for 120,000
//   source A. Lang et al.: PointPillars, CVPR 2019, with figures in place of its learned ones
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "vehicle/autonomy/perception/lidar/point_cloud.hpp"
#include "vehicle/autonomy/perception/lidar/track_ground.hpp"

namespace pitwall::perception {

struct PillarGrid {
  static constexpr std::size_t kRows = 768, kColumns = 96;
  static constexpr double kLength_m = 0.4, kWidth_m = 0.25;  // of a cell, along and across
  static constexpr double kBehind_m = 102.4;                 // of us, begins the first row
  static constexpr double kRight_m = 0.5 * kWidth_m * static_cast<double>(kColumns);
  static constexpr std::size_t kCells = kRows * kColumns;
};

enum class PillarFeature : std::uint8_t {
  kLow,         // log2(1 + points on the road) / 4
  kHigh,        // log2(1 + points over it) / 4
  kTop_m,       // height over the road, the greatest
  kBottom_m,    // the least
  kMean_m,      // the mean
  kAhead,       // mean place in the cell, -1 to 1: along
  kLeft,        // across
  kSurface,     // share of points that have a neighbour on the same surface: little in dust
  kRange_100m,  // distance from us in 100 m
  kWall_m,      // distance to the nearer wall, at most kWallMost_m
};
inline constexpr std::size_t kPillarFeatures = 10;
inline constexpr double kWallMost_m = 3.0;

struct Pillar {
  std::uint32_t cell = 0;  // row x kColumns + column
  std::array<float, kPillarFeatures> features{};
};

std::vector<Pillar> pillars_of(std::span<const LidarPoint> cloud, const TrackGround& ground,
                               double others_mps);

// The network's input: kPillarFeatures planes of `rows` x kColumns, from `first_row` on; 0 where
// there is no point.
std::vector<float> planes_of(std::span<const Pillar> pillars, std::size_t first_row = 0,
                             std::size_t rows = PillarGrid::kRows);

}  // namespace pitwall::perception
