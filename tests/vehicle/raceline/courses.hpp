// Tracks and a car for the tests of racelines.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "protocol/vocabulary/random.hpp"
#include "vehicle/raceline/line_check.hpp"
#include "vehicle/raceline/spline/spiro_spline.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::raceline {

inline constexpr double kMargin_m = 1.3;  // from the middle of a car to a side of its lane

template <class T>
T valid(Result<T, Problem> result) {
  if (!result) throw std::runtime_error(to_string(result.error()));
  return *std::move(result);
}

inline CarLimits car_limits() {
  return {.width_m = 2.0,
          .wheelbase_m = 3.0,
          .steer_max_rad = 0.2,
          .steer_rate_max_rad_per_s = 0.6,
          .corner_speed_mps = [](double, double) { return 70.0; }};
}

inline world::TrackDescription described(const std::string& name, double length_m) {
  world::TrackDescription d;
  d.name = name, d.source = name + ".yaml", d.length_m = length_m;
  d.datum_latitude_deg = 36.0, d.datum_longitude_deg = -115.0, d.datum_height_m = 600.0;
  return d;
}

// Left-hand: two straights of 500 m and two half circles of 200 m, joined by ramps of 80 m, banked
// in the turns; 8 m to the left wall and 10 m to the right one. The pit lane lies 18 m to the left,
// across the start.
inline world::TrackDescription stadium() {
  constexpr double kStraight_m = 500.0, kRadius_m = 200.0, kRamp_m = 80.0;
  const double arc_m = std::numbers::pi * kRadius_m - kRamp_m;  // ramps turn half as much
  const double half_m = kStraight_m + 2.0 * kRamp_m + arc_m;
  world::TrackDescription d = described("stadium", 2.0 * half_m);
  d.start_x_m = -100.0, d.start_y_m = 50.0, d.start_yaw_rad = 0.7;
  for (const double from_m : {0.0, half_m})
    for (const auto& [s_m, k] : {std::pair{0.0, 0.0}, std::pair{kStraight_m, 0.0},
                                 std::pair{kStraight_m + kRamp_m, 1.0 / kRadius_m},
                                 std::pair{kStraight_m + kRamp_m + arc_m, 1.0 / kRadius_m}})
      d.knots.push_back({from_m + s_m, k, 40.0 * k, 8.0, 10.0});
  d.pit = {.entry_s_m = d.length_m - 60.0,
           .exit_s_m = 480.0,
           .offset_m = 18.0,
           .width_m = 12.0,
           .speed_limit_mps = 20.0};
  return d;
}

// The same driven the other way round.
inline world::TrackDescription mirrored(world::TrackDescription d) {
  for (world::TrackKnot& k : d.knots) {
    k.curvature_per_m = -k.curvature_per_m, k.bank_rad = -k.bank_rad;
    std::swap(k.width_left_m, k.width_right_m);
  }
  if (d.pit) d.pit->offset_m = -d.pit->offset_m;
  return d;
}

// A circle of 200 m, left-hand, level, 8 m to both walls; its middle at the origin.
inline world::TrackDescription ring() {
  constexpr double kRadius_m = 200.0;
  world::TrackDescription d = described("ring", 2.0 * std::numbers::pi * kRadius_m);
  d.start_x_m = kRadius_m, d.start_yaw_rad = 0.5 * std::numbers::pi;
  for (double s_m = 0.0; s_m < d.length_m; s_m += 100.0)
    d.knots.push_back({s_m, 1.0 / kRadius_m, 0.0, 8.0, 8.0});
  return d;
}

// A circuit with corners to both sides, of 35 to 300 m: five to the left, one to the right.
inline world::TrackDescription circuit() {
  const std::vector<Place> points{{0, 0},     {360, -90}, {780, 30},  {930, 360},
                                  {690, 570}, {450, 390}, {180, 540}, {-120, 330}};
  const SpiroSpline spline = valid(SpiroSpline::through(points));
  world::TrackDescription d = described("circuit", spline.length_m());
  d.start_yaw_rad = spline.at(0.0).yaw_rad;
  for (double s_m = 0.0; s_m < d.length_m; s_m += 4.0)
    d.knots.push_back({s_m, spline.at(s_m).curvature_per_m, 0.0, 7.0, 7.0});
  return d;
}

struct Range {
  double least = 0.0, most = 0.0;
  double draw(Random& random) const { return random.between(least, most); }
};

// A circuit through drawn points that lie about `size` from its middle, as wide to either wall as
// drawn of `width`.
inline world::TrackDescription drawn_circuit(std::uint64_t seed, Range size, Range width) {
  Random random{seed};
  const std::uint64_t count = 6 + random.below(10);
  const double size_m = size.draw(random);
  std::vector<Place> points;
  for (std::uint64_t i = 0; i < count; ++i) {
    const double angle_rad =
        2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    const double radius_m = size_m * random.between(0.68, 1.32);
    points.push_back({1.5 * radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad)});
  }
  const SpiroSpline spline = valid(SpiroSpline::through(points));
  world::TrackDescription d = described("drawn", spline.length_m());
  d.start_yaw_rad = spline.at(0.0).yaw_rad;
  const double left_m = width.draw(random), right_m = width.draw(random);
  for (double s_m = 0.0; s_m < d.length_m - 2.0; s_m += 4.0)
    d.knots.push_back({s_m, spline.at(s_m).curvature_per_m, 0.0, left_m, right_m});
  return d;
}

}  // namespace pitwall::raceline
