// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/clusters/cloth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pitwall::perception {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();
constexpr std::size_t kSideMax = 2048;  // cells; a larger area is cut

struct Area {
  float from_x_m = kNothing, from_y_m = kNothing, to_x_m = -kNothing, to_y_m = -kNothing;
  float lowest_m = kNothing;
};

Area area_of(std::span<const LidarPoint> points) {
  Area a;
  for (const LidarPoint& p : points) {
    a.from_x_m = std::min(a.from_x_m, p.x_m), a.to_x_m = std::max(a.to_x_m, p.x_m);
    a.from_y_m = std::min(a.from_y_m, p.y_m), a.to_y_m = std::max(a.to_y_m, p.y_m);
    a.lowest_m = std::min(a.lowest_m, p.z_m);
  }
  return a;
}

// Particles of the cloth, column by column.
struct Grid {
  std::size_t columns = 1, rows = 1;

  std::size_t size() const { return columns * rows; }
  std::size_t at(std::size_t column, std::size_t row) const { return column * rows + row; }
};

template <class Visit>
void visit_neighbours(const Grid& grid, std::size_t i, Visit visit) {
  const std::size_t column = i / grid.rows, row = i % grid.rows;
  if (column > 0) visit(i - grid.rows);
  if (column + 1 < grid.columns) visit(i + grid.rows);
  if (row > 0) visit(i - 1);
  if (row + 1 < grid.rows) visit(i + 1);
}

// Cells without a point take the value of a neighbour that has one, ring by ring.
void fill_holes(const Grid& grid, std::vector<float>& stop_m) {
  std::vector<std::size_t> known, next;
  for (std::size_t i = 0; i < stop_m.size(); ++i)
    if (stop_m[i] < kNothing) known.push_back(i);
  while (!known.empty()) {
    next.clear();
    for (const std::size_t i : known)
      visit_neighbours(grid, i, [&](std::size_t to) {
        if (stop_m[to] < kNothing) return;
        stop_m[to] = stop_m[i];
        next.push_back(to);
      });
    std::swap(known, next);
  }
}

// The cloth rises from below the lowest point, and nowhere above the points. Its particles hold
// each other back, so that it spans the foot of what is narrow.
class Rising {
 public:
  Rising(const Grid& grid, std::vector<float> stop_m, float from_m, const ClothParams& params)
      : grid_(grid),
        stop_m_(std::move(stop_m)),
        now_m_(grid.size(), from_m),
        before_m_(now_m_),
        lift_m_(static_cast<float>(params.gravity_mps2 * params.step_s * params.step_s)),
        kept_(static_cast<float>(1.0 - params.damping)),
        pull_(static_cast<float>(0.5 * params.pull)) {}

  // The largest way of a particle.
  float step() {
    rise();
    pull_together();
    return meet();
  }
  std::vector<float> heights() && { return std::move(now_m_); }

 private:
  void rise() {
    for (std::size_t i = 0; i < now_m_.size(); ++i) {
      const float was_m = now_m_[i];
      now_m_[i] += kept_ * (was_m - before_m_[i]) + lift_m_;
      before_m_[i] = was_m;
    }
  }
  void pull_pair(std::size_t a, std::size_t b) {
    const float way_m = pull_ * (now_m_[b] - now_m_[a]);
    now_m_[a] += way_m;
    now_m_[b] -= way_m;
  }
  void pull_together() {
    for (std::size_t column = 0; column < grid_.columns; ++column)
      for (std::size_t row = 0; row < grid_.rows; ++row) {
        const std::size_t i = grid_.at(column, row);
        if (row + 1 < grid_.rows) pull_pair(i, i + 1);
        if (column + 1 < grid_.columns) pull_pair(i, i + grid_.rows);
      }
  }
  float meet() {
    float most_m = 0.0F;
    for (std::size_t i = 0; i < now_m_.size(); ++i) {
      now_m_[i] = std::min(now_m_[i], stop_m_[i]);
      most_m = std::max(most_m, std::abs(now_m_[i] - before_m_[i]));
    }
    return most_m;
  }

  Grid grid_;
  std::vector<float> stop_m_, now_m_, before_m_;
  float lift_m_, kept_, pull_;
};

std::size_t cells_of(float length_m, double cell_m) {
  return std::min(kSideMax, static_cast<std::size_t>(std::ceil(length_m / cell_m)) + 1);
}

}  // namespace

Cloth::Cloth(std::span<const LidarPoint> points, const ClothParams& params)
    : cell_m_(params.cell_m), height_m_(1, 0.0F) {
  if (points.empty()) return;
  const Area area = area_of(points);
  from_x_m_ = area.from_x_m, from_y_m_ = area.from_y_m;
  columns_ = cells_of(area.to_x_m - area.from_x_m, cell_m_);
  rows_ = cells_of(area.to_y_m - area.from_y_m, cell_m_);
  const Grid grid{columns_, rows_};
  std::vector<float> stop_m(grid.size(), kNothing);
  for (const LidarPoint& p : points) {
    const auto column = static_cast<std::size_t>((p.x_m - area.from_x_m) / cell_m_ + 0.5);
    const auto row = static_cast<std::size_t>((p.y_m - area.from_y_m) / cell_m_ + 0.5);
    if (column >= columns_ || row >= rows_) continue;
    float& stop = stop_m[grid.at(column, row)];
    stop = std::min(stop, p.z_m);
  }
  fill_holes(grid, stop_m);
  Rising cloth{grid, std::move(stop_m), area.lowest_m - static_cast<float>(cell_m_), params};
  for (int k = 0; k < params.steps_most; ++k)
    if (cloth.step() < params.still_m) break;
  height_m_ = std::move(cloth).heights();
}

double Cloth::height_m(double x_m, double y_m) const {
  const double u = std::clamp((x_m - from_x_m_) / cell_m_, 0.0, static_cast<double>(columns_ - 1));
  const double v = std::clamp((y_m - from_y_m_) / cell_m_, 0.0, static_cast<double>(rows_ - 1));
  const auto column = static_cast<std::size_t>(u), row = static_cast<std::size_t>(v);
  const std::size_t next_column = std::min(column + 1, columns_ - 1);
  const std::size_t next_row = std::min(row + 1, rows_ - 1);
  const auto at = [&](std::size_t c, std::size_t r) {
    return static_cast<double>(height_m_[c * rows_ + r]);
  };
  const double du = u - static_cast<double>(column), dv = v - static_cast<double>(row);
  return (1.0 - du) * ((1.0 - dv) * at(column, row) + dv * at(column, next_row)) +
         du * ((1.0 - dv) * at(next_column, row) + dv * at(next_column, next_row));
}

}  // namespace pitwall::perception
