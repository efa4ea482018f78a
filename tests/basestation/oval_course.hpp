// Oval course: two straights along x and two half circles, driven counterclockwise from the middle
// of a straight.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "basestation/state/course.hpp"

namespace pitwall {

struct Oval {
  double straight_m = 600.0, radius_m = 200.0;

  double turn_m() const { return std::numbers::pi * radius_m; }
  double length_m() const { return 2.0 * (straight_m + turn_m()); }

  state::CoursePoint at(double s_m) const {
    const double half = straight_m / 2.0;
    const bool far = s_m >= half + turn_m() && s_m < half + turn_m() + straight_m;
    if (s_m < half) return {s_m, s_m, 0.0, 0.0, 0.0};
    if (far) {
      const double along = s_m - half - turn_m();
      return {s_m, half - along, 2.0 * radius_m, std::numbers::pi, 0.0};
    }
    if (s_m >= length_m() - half) return {s_m, s_m - length_m(), 0.0, 0.0, 0.0};
    const bool second = s_m > half + turn_m();
    const double angle = (s_m - half - (second ? turn_m() + straight_m : 0.0)) / radius_m;
    const double side = second ? -1.0 : 1.0;
    return {s_m, side * (half + radius_m * std::sin(angle)),
            radius_m - side * radius_m * std::cos(angle),
            wrap_pi(angle + (second ? std::numbers::pi : 0.0)), 1.0 / radius_m};
  }

  state::Course course(double spacing_m = 5.0) const {
    std::vector<state::CoursePoint> points;
    for (double s = 0.0; s < length_m() - spacing_m / 2.0; s += spacing_m) points.push_back(at(s));
    return *state::Course::make(std::move(points), length_m());
  }
};

}  // namespace pitwall
