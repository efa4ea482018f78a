// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/clusters/box_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pitwall::perception {
namespace {

constexpr int kCoarse = 30, kFine = 12;  // headings; the fine ones lie about the best coarse one
constexpr double kQuarter_rad = 0.5 * std::numbers::pi;
constexpr double kNearest_m = 0.02;  // closer to a side than its noise no point counts for more

struct Reach {
  double least = std::numeric_limits<double>::infinity(), most = -least;

  void add(double value) { least = std::min(least, value), most = std::max(most, value); }
  double middle() const { return 0.5 * (least + most); }
  double to_side(double value) const { return std::min(most - value, value - least); }
};

struct Sides {
  Reach along, across;
};

Sides sides_of(std::span<const PlanePoint> points, const Axes& axes) {
  Sides sides;
  for (const PlanePoint& p : points) {
    sides.along.add(axes.along(p));
    sides.across.add(axes.across(p));
  }
  return sides;
}

double closeness(std::span<const PlanePoint> points, double yaw_rad) {
  const Axes axes{yaw_rad};
  const Sides sides = sides_of(points, axes);
  double sum = 0.0;
  for (const PlanePoint& p : points)
    sum += 1.0 / std::max(kNearest_m, std::min(sides.along.to_side(axes.along(p)),
                                               sides.across.to_side(axes.across(p))));
  return sum;
}

double best_heading(std::span<const PlanePoint> points, double from_rad, double step_rad,
                    int count) {
  double best_rad = from_rad, most = -1.0;
  for (int i = 0; i < count; ++i) {
    const double yaw_rad = from_rad + i * step_rad;
    const double close = closeness(points, yaw_rad);
    if (close > most) most = close, best_rad = yaw_rad;
  }
  return best_rad;
}

}  // namespace

Rectangle fit_rectangle(std::span<const PlanePoint> points) {
  constexpr double kStep_rad = kQuarter_rad / kCoarse, kFineStep_rad = 2.0 * kStep_rad / kFine;
  const double about_rad = best_heading(points, 0.0, kStep_rad, kCoarse);
  double yaw_rad = best_heading(points, about_rad - kStep_rad, kFineStep_rad, kFine + 1);
  return rectangle_at(points, yaw_rad - kQuarter_rad * std::floor(yaw_rad / kQuarter_rad));
}

Rectangle rectangle_at(std::span<const PlanePoint> points, double yaw_rad) {
  const Axes axes{yaw_rad};
  const Sides sides = sides_of(points, axes);
  const PlanePoint centre = axes.at(sides.along.middle(), sides.across.middle());
  return {.x_m = centre.x_m,
          .y_m = centre.y_m,
          .yaw_rad = yaw_rad,
          .along_m = sides.along.most - sides.along.least,
          .across_m = sides.across.most - sides.across.least};
}

}  // namespace pitwall::perception
