// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/lanes/apexes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/vehicle/raceline/courses.hpp"

namespace pitwall::raceline {
namespace {

Raceline centre_of(const Lanes& lanes, Region region) {
  const auto points = valid(parallel_waypoints(lanes, region, Side::kCentre, kMargin_m));
  return sample_raceline(valid(fit_between(lanes, region, kMargin_m, points)), lanes.track(), 1.0);
}

TEST(Apexes, LieInTheMiddleOfEachTurn) {
  for (const bool is_left : {true, false}) {
    const auto description = is_left ? stadium() : mirrored(stadium());
    const world::TrackMap track = valid(world::TrackMap::build(description));
    const auto apexes = find_apexes(centre_of(Lanes{track}, Region::kInnerLane), track);
    ASSERT_EQ(apexes.size(), 2U);
    // A turn and its ramps are pi 200 + 80 m long and begin after 500 m.
    const double middle_m = 500.0 + 0.5 * (std::numbers::pi * 200.0 + 80.0);
    EXPECT_NEAR(apexes[0].s_m, middle_m, 20.0);
    EXPECT_NEAR(apexes[1].s_m, middle_m + 0.5 * track.length_m(), 20.0);
    for (const Apex& apex : apexes) EXPECT_EQ(apex.is_left, is_left);
  }
}

TEST(Apexes, AreFoundInCornersOfBothDirections) {
  const world::TrackDescription description = circuit();
  const world::TrackMap track = valid(world::TrackMap::build(description));
  const auto apexes = find_apexes(centre_of(Lanes{track}, Region::kOuterLane), track);
  EXPECT_EQ(std::ranges::count(apexes, false, &Apex::is_left), 1);
  EXPECT_GE(std::ranges::count(apexes, true, &Apex::is_left), 3);
  for (const Apex& apex : apexes) {
    const double here = track.at(apex.s_m).curvature_per_m;
    EXPECT_EQ(here > 0.0, apex.is_left);
    for (const double away_m : {-60.0, 60.0})
      EXPECT_GT(std::abs(here), std::abs(track.at(apex.s_m + away_m).curvature_per_m)) << apex.s_m;
  }
  EXPECT_TRUE(std::ranges::is_sorted(apexes, {}, &Apex::s_m));
}

TEST(Apexes, LineGoesFromTheOutsideToThemAndOut) {
  const world::TrackMap track = valid(world::TrackMap::build(stadium()));
  const Lanes lanes{track};
  const Raceline centre = centre_of(lanes, Region::kInnerLane);
  const auto waypoints = apex_waypoints(lanes, Region::kInnerLane, centre, kMargin_m, {});
  ASSERT_EQ(waypoints.size(), 4U);
  for (const Waypoint& w : waypoints) {
    const Band free = lanes.band(Region::kInnerLane, w.s_m).narrowed(kMargin_m);
    const bool is_turn = track.at(w.s_m).curvature_per_m > 0.004;
    EXPECT_NEAR(w.n_m, is_turn ? free.left_m : free.right_m, 1e-9) << w.s_m;
  }
  const SpiroSpline line = valid(fit_between(lanes, Region::kInnerLane, kMargin_m, waypoints));
  EXPECT_LT(line.length_m(), centre.length_m);  // it is inside where the turns are
}

// Between a corner and one of the other direction the line crosses the middle of the lane.
TEST(Apexes, BetweenCornersOfBothDirectionsLiesTheMiddle) {
  const world::TrackDescription description = circuit();
  const world::TrackMap track = valid(world::TrackMap::build(description));
  const Lanes lanes{track};
  const Raceline centre = centre_of(lanes, Region::kOuterLane);
  const auto apexes = find_apexes(centre, track);
  const auto waypoints = apex_waypoints(lanes, Region::kOuterLane, centre, kMargin_m, {});
  ASSERT_EQ(waypoints.size(), 2 * apexes.size());
  int middles = 0;
  for (std::size_t i = 0; i < apexes.size(); ++i) {
    const Apex &a = apexes[i], &b = apexes[(i + 1) % apexes.size()];
    const double span_m = track.station_ahead(a.s_m, b.s_m);
    for (const Waypoint& w : waypoints) {
      const double ahead_m = track.station_ahead(a.s_m, w.s_m);
      if (ahead_m < 1.0 || ahead_m > span_m - 1.0) continue;
      const Band free = lanes.band(Region::kOuterLane, w.s_m).narrowed(kMargin_m);
      const double outside_m = a.is_left ? free.right_m : free.left_m;
      EXPECT_NEAR(w.n_m, a.is_left == b.is_left ? outside_m : free.middle_m(), 1e-9) << w.s_m;
      if (a.is_left != b.is_left) ++middles;
    }
  }
  EXPECT_EQ(middles, 2);  // into the one corner to the right, and out of it
}

TEST(Apexes, ThoseOfAPersonStandInstead) {
  const world::TrackMap track = valid(world::TrackMap::build(stadium()));
  const Lanes lanes{track};
  const Raceline centre = centre_of(lanes, Region::kInnerLane);
  const std::vector<Waypoint> given{{700.0, 5.0}, {1000.0, 5.5}, {2000.0, 4.5}};
  const auto waypoints = apex_waypoints(lanes, Region::kInnerLane, centre, kMargin_m, given);
  EXPECT_EQ(waypoints.size(), 6U);  // and one between each two
  for (const Waypoint& w : given)
    EXPECT_TRUE(std::ranges::any_of(waypoints, [&](const Waypoint& other) {
      return other.s_m == w.s_m && other.n_m == w.n_m;
    }));
}

TEST(Apexes, ALapWithoutStraightsHasALineToo) {
  const world::TrackMap track = valid(world::TrackMap::build(ring()));
  const Lanes lanes{track};
  const Raceline centre = centre_of(lanes, Region::kOuterLane);
  const auto waypoints = apex_waypoints(lanes, Region::kOuterLane, centre, kMargin_m, {});
  EXPECT_TRUE(fit_between(lanes, Region::kOuterLane, kMargin_m, waypoints));
}

}  // namespace
}  // namespace pitwall::raceline
