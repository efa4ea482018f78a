// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/pillars/pillar_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "vehicle/autonomy/perception/lidar/surface.hpp"

namespace pitwall::perception {
namespace {

constexpr double kLowest_m = -0.5, kHighest_m = 2.5;        // over the road: what is looked at
constexpr double kRoadMost_m = 0.15, kMovedLeast_m = 0.05;  // over it: on the road; may move
constexpr std::uint32_t kNoPillar = std::numeric_limits<std::uint32_t>::max();

// A point in its cell.
struct Placed {
  std::uint32_t cell;
  double ahead_m, n_m, over_m, wall_m;
  float in_ahead, in_left;  // of its cell, -1 to 1
};

std::optional<Placed> placed(const LidarPoint& p, const TrackGround& ground, double others_mps) {
  const auto at = is_finite(p) ? ground.at(p) : std::nullopt;
  if (!at || at->over_m < kLowest_m || at->over_m > kHighest_m) return std::nullopt;
  const double went_m = at->over_m < kMovedLeast_m ? 0.0 : others_mps * p.after_s;
  const double ahead_m = ground.ahead_m(at->place) - went_m, n_m = at->place.n_m;
  const double row = (ahead_m + PillarGrid::kBehind_m) / PillarGrid::kLength_m;
  const double column = (n_m + PillarGrid::kRight_m) / PillarGrid::kWidth_m;
  if (!(row >= 0.0 && row < PillarGrid::kRows && column >= 0.0 && column < PillarGrid::kColumns))
    return std::nullopt;
  const double whole_row = std::floor(row), whole_column = std::floor(column);
  return Placed{.cell = static_cast<std::uint32_t>(whole_row * PillarGrid::kColumns + whole_column),
                .ahead_m = ahead_m,
                .n_m = n_m,
                .over_m = at->over_m,
                .wall_m = std::min(at->place.wall_m, kWallMost_m),
                .in_ahead = static_cast<float>(2.0 * (row - whole_row) - 1.0),
                .in_left = static_cast<float>(2.0 * (column - whole_column) - 1.0)};
}

float& of(Pillar& pillar, PillarFeature feature) {
  return pillar.features[static_cast<std::size_t>(feature)];
}

// Counts and sums; `finish` makes figures of them.
void add(Pillar& pillar, const Placed& point, bool is_on_surface) {
  using enum PillarFeature;
  const auto over_m = static_cast<float>(point.over_m);
  const bool is_first = of(pillar, kLow) + of(pillar, kHigh) == 0.0F;
  of(pillar, point.over_m < kRoadMost_m ? kLow : kHigh) += 1.0F;
  of(pillar, kTop_m) = is_first ? over_m : std::max(of(pillar, kTop_m), over_m);
  of(pillar, kBottom_m) = is_first ? over_m : std::min(of(pillar, kBottom_m), over_m);
  of(pillar, kMean_m) += over_m;
  of(pillar, kAhead) += point.in_ahead;
  of(pillar, kLeft) += point.in_left;
  of(pillar, kSurface) += is_on_surface ? 1.0F : 0.0F;
  of(pillar, kWall_m) += static_cast<float>(point.wall_m);
}

void finish(Pillar& pillar, double range_m) {
  using enum PillarFeature;
  const float points = of(pillar, kLow) + of(pillar, kHigh);
  for (const PillarFeature mean : {kMean_m, kAhead, kLeft, kSurface, kWall_m})
    of(pillar, mean) /= points;
  for (const PillarFeature count : {kLow, kHigh})
    of(pillar, count) = 0.25F * std::log2(1.0F + of(pillar, count));
  of(pillar, kRange_100m) = static_cast<float>(0.01 * range_m);
}

}  // namespace

std::vector<Pillar> pillars_of(std::span<const LidarPoint> cloud, const TrackGround& ground,
                               double others_mps) {
  std::vector<Pillar> pillars;
  std::vector<double> range_m;
  std::vector<std::uint32_t> pillar_of(PillarGrid::kCells, kNoPillar);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto point = placed(cloud[i], ground, others_mps);
    if (!point) continue;
    std::uint32_t& pillar = pillar_of[point->cell];
    if (pillar == kNoPillar) {
      pillar = static_cast<std::uint32_t>(pillars.size());
      pillars.push_back({.cell = point->cell});
      range_m.push_back(std::hypot(cloud[i].x_m, cloud[i].y_m));
    }
    add(pillars[pillar], *point, has_surface(cloud, i));
  }
  for (std::size_t i = 0; i < pillars.size(); ++i) finish(pillars[i], range_m[i]);
  std::ranges::sort(pillars, {}, &Pillar::cell);
  return pillars;
}

std::vector<float> planes_of(std::span<const Pillar> pillars, std::size_t first_row,
                             std::size_t rows) {
  const std::size_t first = first_row * PillarGrid::kColumns, cells = rows * PillarGrid::kColumns;
  std::vector<float> planes(kPillarFeatures * cells, 0.0F);
  for (const Pillar& pillar : pillars) {
    if (pillar.cell < first || pillar.cell >= first + cells) continue;
    for (std::size_t f = 0; f < kPillarFeatures; ++f)
      planes[f * cells + (pillar.cell - first)] = pillar.features[f];
  }
  return planes;
}

}  // namespace pitwall::perception
