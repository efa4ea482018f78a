// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/lanes/raceline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/vehicle/raceline/courses.hpp"

namespace pitwall::raceline {
namespace {

// Points on the ring's centre line, the first of them a third of a lap from the start.
SpiroSpline ring_spline(double radius_m) {
  std::vector<Place> points;
  for (int i = 0; i < 9; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * (i / 9.0 + 1.0 / 3.0);
    points.push_back({radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad)});
  }
  return valid(SpiroSpline::through(points));
}

TEST(Raceline, BeginsBesideTheStart) {
  const world::TrackMap track = valid(world::TrackMap::build(ring()));
  const Raceline line = sample_raceline(ring_spline(196.0), track, 1.0);
  EXPECT_NEAR(line.points[0].x_m, 196.0, 1e-6);
  EXPECT_NEAR(line.points[0].y_m, 0.0, 1e-4);
}

TEST(Raceline, HasEvenStepsNoLongerThanAsked) {
  const world::TrackMap track = valid(world::TrackMap::build(ring()));
  const Raceline line = sample_raceline(ring_spline(196.0), track, 1.0);
  EXPECT_NEAR(line.length_m, 2.0 * std::numbers::pi * 196.0, 1e-6);
  EXPECT_LE(line.spacing_m(), 1.0);
  EXPECT_GT(line.spacing_m(), 0.99);
  const double chord_m = 2.0 * 196.0 * std::sin(0.5 * line.spacing_m() / 196.0);
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const RacelinePoint &a = line.points[i], &b = line.points[(i + 1) % line.points.size()];
    EXPECT_NEAR(std::hypot(b.x_m - a.x_m, b.y_m - a.y_m), chord_m, 1e-8) << i;
    EXPECT_NEAR(a.curvature_per_m, 1.0 / 196.0, 1e-9);
    EXPECT_NEAR(std::cos(a.yaw_rad), -a.y_m / 196.0, 1e-8) << i;
  }
}

TEST(Raceline, HasTheBankingOfTheRoadBesideIt) {
  const world::TrackDescription description = stadium();
  const world::TrackMap track = valid(world::TrackMap::build(description));
  std::vector<Place> points;
  for (double s_m = 0.0; s_m < track.length_m(); s_m += 40.0) {
    const world::TrackPoint p = track.offset(s_m, 3.0);
    points.push_back({p.x_m, p.y_m});
  }
  const Raceline line = sample_raceline(valid(SpiroSpline::through(points)), track, 1.0);
  double most_rad = 0.0;
  for (const RacelinePoint& p : line.points) {
    const double station_m = track.project(p.x_m, p.y_m).s_m;
    EXPECT_NEAR(p.bank_rad, track.at(station_m).bank_rad, 1e-6);
    most_rad = std::max(most_rad, p.bank_rad);
  }
  EXPECT_NEAR(most_rad, 0.2, 1e-3);
}

}  // namespace
}  // namespace pitwall::raceline
