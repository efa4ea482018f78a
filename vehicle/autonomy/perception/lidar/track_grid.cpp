// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/track_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pitwall::perception {
namespace {

constexpr double kGridCell_m = 2.0, kGridStep_m = 0.5 * kGridCell_m;
constexpr std::uint32_t kNoSample = std::numeric_limits<std::uint32_t>::max();

}  // namespace

TrackGrid::TrackGrid(const world::TrackMap& track) : track_(&track) {
  const auto steps = static_cast<std::size_t>(std::ceil(track.length_m() / kGridStep_m));
  double to_x_m = -std::numeric_limits<double>::infinity(), to_y_m = to_x_m;
  from_x_m_ = from_y_m_ = -to_x_m;
  for (std::size_t i = 0; i < steps; ++i) {
    const double s_m = track.length_m() * static_cast<double>(i) / static_cast<double>(steps);
    const world::TrackPoint p = track.at(s_m);
    samples_.push_back({p, std::cos(p.yaw_rad), std::sin(p.yaw_rad), -std::tan(p.bank_rad)});
    const double widest_m = std::max(p.width_left_m, p.width_right_m) + kGridCell_m;
    from_x_m_ = std::min(from_x_m_, p.x_m - widest_m), to_x_m = std::max(to_x_m, p.x_m + widest_m);
    from_y_m_ = std::min(from_y_m_, p.y_m - widest_m), to_y_m = std::max(to_y_m, p.y_m + widest_m);
  }
  columns_ = static_cast<std::size_t>(std::ceil((to_x_m - from_x_m_) / kGridCell_m));
  rows_ = static_cast<std::size_t>(std::ceil((to_y_m - from_y_m_) / kGridCell_m));
  cells_.assign(columns_ * rows_, kNoSample);
  std::vector<double> distance_m(cells_.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const Sample& sample = samples_[i];
    // Past the walls too, so that every cell that a wall crosses has its sample.
    for (double n_m = -sample.point.width_right_m - kGridCell_m;
         n_m <= sample.point.width_left_m + kGridCell_m; n_m += kGridStep_m) {
      const std::size_t cell =
          cell_of(sample.point.x_m - n_m * sample.sin_yaw, sample.point.y_m + n_m * sample.cos_yaw);
      if (cell == cells_.size()) continue;
      const double middle_x_m =
          from_x_m_ + kGridCell_m * (static_cast<double>(cell % columns_) + 0.5);
      const double middle_y_m =
          from_y_m_ + kGridCell_m * (static_cast<double>(cell / columns_) + 0.5);
      const double along_m = std::abs((middle_x_m - sample.point.x_m) * sample.cos_yaw +
                                      (middle_y_m - sample.point.y_m) * sample.sin_yaw);
      if (along_m >= distance_m[cell]) continue;
      distance_m[cell] = along_m, cells_[cell] = static_cast<std::uint32_t>(i);
    }
  }
}

std::size_t TrackGrid::cell_of(double x_m, double y_m) const {
  const double column = (x_m - from_x_m_) / kGridCell_m, row = (y_m - from_y_m_) / kGridCell_m;
  if (!(column >= 0.0 && row >= 0.0 && column < static_cast<double>(columns_) &&
        row < static_cast<double>(rows_)))
    return cells_.size();
  return static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column);
}

std::optional<TrackPlace> TrackGrid::at(double x_m, double y_m) const {
  const std::size_t cell = cell_of(x_m, y_m);
  if (cell == cells_.size() || cells_[cell] == kNoSample) return std::nullopt;
  const Sample& sample = samples_[cells_[cell]];
  const double dx_m = x_m - sample.point.x_m, dy_m = y_m - sample.point.y_m;
  const double along_m = dx_m * sample.cos_yaw + dy_m * sample.sin_yaw;
  // The line bends away from the tangent.
  const double n_m = dy_m * sample.cos_yaw - dx_m * sample.sin_yaw -
                     0.5 * sample.point.curvature_per_m * along_m * along_m;
  const double wall_m = std::min(sample.point.width_left_m - n_m, sample.point.width_right_m + n_m);
  if (wall_m < 0.0) return std::nullopt;
  return TrackPlace{.s_m = sample.point.s_m + along_m,
                    .n_m = n_m,
                    .height_m = n_m * sample.rise,
                    .yaw_rad = sample.point.yaw_rad,
                    .bank_rad = sample.point.bank_rad,
                    .wall_m = wall_m};
}

}  // namespace pitwall::perception
