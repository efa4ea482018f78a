// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/optimum/minimum_curvature.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/raceline/courses.hpp"
#include "vehicle/raceline/lanes/apexes.hpp"

namespace pitwall::raceline {
namespace {

// The integral of the curvature squared.
double bend_of(const SpiroSpline& spline) {
  double sum = 0.0;
  for (double s_m = 0.25; s_m < spline.length_m(); s_m += 0.5) {
    const double curvature = spline.at(s_m).curvature_per_m;
    sum += 0.5 * curvature * curvature;
  }
  return sum;
}

SpiroSpline spline_of(const Lanes& lanes, const std::vector<Waypoint>& waypoints) {
  return valid(fit_between(lanes, Region::kTrack, kMargin_m, waypoints));
}

// Of all circles within a ring the widest: around a lap the integral is 2 pi over the radius.
TEST(MinimumCurvature, OfARingIsItsOuterSide) {
  const world::TrackMap track = valid(world::TrackMap::build(ring()));
  for (const Waypoint& w : valid(minimum_curvature(Lanes{track}, kMargin_m)))
    EXPECT_NEAR(w.n_m, -(8.0 - kMargin_m), 1e-3) << w.s_m;
}

TEST(MinimumCurvature, IsLessThanThatOfOtherLines) {
  for (const auto& description : {stadium(), mirrored(stadium()), circuit()}) {
    const world::TrackMap track = valid(world::TrackMap::build(description));
    const Lanes lanes{track};
    const double least = bend_of(spline_of(lanes, valid(minimum_curvature(lanes, kMargin_m))));
    for (const Side side : {Side::kInside, Side::kCentre, Side::kOutside}) {
      const SpiroSpline other =
          spline_of(lanes, valid(parallel_waypoints(lanes, Region::kTrack, side, kMargin_m)));
      EXPECT_LT(least, bend_of(other)) << track.name();
      const Raceline centre = sample_raceline(other, track, 1.0);
      const auto apexes = apex_waypoints(lanes, Region::kTrack, centre, kMargin_m, {});
      EXPECT_LT(least, bend_of(spline_of(lanes, apexes))) << track.name();
    }
  }
}

// A hump on the line, wherever it is and to whichever side, adds to the integral, unless it leads
// over the margin.
TEST(MinimumCurvature, NoHumpMakesItLess) {
  const world::TrackDescription description = circuit();
  const world::TrackMap track = valid(world::TrackMap::build(description));
  const Lanes lanes{track};
  const auto best = valid(minimum_curvature(lanes, kMargin_m));
  const double least = bend_of(spline_of(lanes, best));
  int tried = 0;
  for (double at_m = 0.0; at_m < track.length_m(); at_m += 60.0)
    for (const double height_m : {-0.5, 0.5}) {
      std::vector<Waypoint> changed = best;
      bool is_free = true;
      for (Waypoint& w : changed) {
        const double away_m = std::remainder(w.s_m - at_m, track.length_m());
        w.n_m += height_m * std::exp(-away_m * away_m / (2.0 * 60.0 * 60.0));
        const Band free = lanes.band(Region::kTrack, w.s_m).narrowed(kMargin_m);
        is_free = is_free && w.n_m < free.left_m && w.n_m > free.right_m;
      }
      if (!is_free) continue;
      ++tried;
      EXPECT_GT(bend_of(spline_of(lanes, changed)), least) << at_m << " " << height_m;
    }
  EXPECT_GT(tried, 5);
}

TEST(MinimumCurvature, RefusesARoadThatIsTooNarrow) {
  world::TrackDescription description = ring();
  for (world::TrackKnot& k : description.knots) k.width_left_m = k.width_right_m = 1.3;
  const world::TrackMap track = valid(world::TrackMap::build(description));
  const auto refused = minimum_curvature(Lanes{track}, kMargin_m);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().place, "ring: s = 0.0 m");
  EXPECT_EQ(refused.error().what, "the track is 2.60 m wide, more than 2.60 m expected");
}

}  // namespace
}  // namespace pitwall::raceline
