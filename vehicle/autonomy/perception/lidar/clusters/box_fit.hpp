// Rectangle about the points of one object, seen from above: of a car a LiDAR sees one side or two,
// an L.
//   in     points in the plane, two at least
//   out    the rectangle whose sides lie closest to the points: its axes, and how far the points
//          reach along them
//   law    turning and moving the points turns and moves the rectangle
//   cost   O(points x headings): 10 us for 100 points
//   source X. Zhang, W. Xu, C. Dong, J. Dolan: Efficient L-shape fitting for vehicle detection
//          using laser scanners, IV 2017, algorithm 2 (search) with algorithm 4 (closeness)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <span>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::perception {

struct PlanePoint {
  double x_m = 0.0, y_m = 0.0;
};

// Of a box that is turned by `yaw_rad`: coordinates along its sides, and back.
struct Axes {
  double cos_yaw, sin_yaw;

  explicit Axes(double yaw_rad) : cos_yaw(std::cos(yaw_rad)), sin_yaw(std::sin(yaw_rad)) {}
  double along(const PlanePoint& p) const { return p.x_m * cos_yaw + p.y_m * sin_yaw; }
  double across(const PlanePoint& p) const { return p.y_m * cos_yaw - p.x_m * sin_yaw; }
  PlanePoint at(double along_m, double across_m) const {
    return {along_m * cos_yaw - across_m * sin_yaw, along_m * sin_yaw + across_m * cos_yaw};
  }
};

struct Rectangle {
  double x_m = kUnset, y_m = kUnset;           // centre
  double yaw_rad = kUnset;                     // of its first side; fitted: in [0, pi/2)
  double along_m = kUnset, across_m = kUnset;  // lengths of its sides
};

Rectangle fit_rectangle(std::span<const PlanePoint> points);
// The one with sides along and across `yaw_rad`.
Rectangle rectangle_at(std::span<const PlanePoint> points, double yaw_rad);

}  // namespace pitwall::perception
