// Synthetic track CSVs for the tests: a stadium of two straights and two half circles.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "hil/track_file/closed_curve.hpp"

namespace pitwall::track_file {

inline constexpr double kStraight_m = 400.0, kRadius_m = 120.0;
inline const double kStadium_m = 2.0 * kStraight_m + 2.0 * std::numbers::pi * kRadius_m;

// Point of the left-hand stadium at station s; s = 0 is the middle of the lower straight.
inline Place stadium_at(double s_m) {
  const double arc_m = std::numbers::pi * kRadius_m;
  const bool back = s_m >= 0.5 * kStadium_m;
  const double t_m = std::fmod(s_m, 0.5 * kStadium_m), half_m = 0.5 * kStraight_m;
  Place p;
  if (t_m < half_m) {
    p = {t_m, -kRadius_m};
  } else if (t_m < half_m + arc_m) {
    const double angle_rad = (t_m - half_m) / kRadius_m;
    p = {half_m + kRadius_m * std::sin(angle_rad), -kRadius_m * std::cos(angle_rad)};
  } else {
    p = {half_m - (t_m - half_m - arc_m), kRadius_m};
  }
  return back ? Place{-p.x_m, -p.y_m} : p;
}

inline std::vector<Place> stadium(double step_m = 5.0) {
  std::vector<Place> places;
  const auto count = static_cast<int>(kStadium_m / step_m);
  for (int i = 0; i < count; ++i) places.push_back(stadium_at(kStadium_m * i / count));
  return places;
}

inline std::string row_text(double a, double b, double right_m, double left_m) {
  char text[128];
  std::snprintf(text, sizeof text, "%.6f,%.9f,%.4f,%.4f\n", a, b, right_m, left_m);
  return text;
}

inline std::string csv_text(const std::vector<Place>& places, double right_m = 7.0,
                            double left_m = 8.0) {
  std::string text = "# x_m,y_m,w_tr_right_m,w_tr_left_m\n";
  for (const Place& p : places) text += row_text(p.x_m, p.y_m, right_m, left_m);
  return text;
}

}  // namespace pitwall::track_file
