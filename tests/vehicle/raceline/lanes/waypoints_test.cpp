// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/lanes/waypoints.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/vehicle/raceline/courses.hpp"

namespace pitwall::raceline {
namespace {

constexpr double kAllowed_m = 0.05;  // of a spline over its margin

// How far the spline goes beyond its margin at its worst.
double excess_of(const SpiroSpline& spline, const Lanes& lanes, Region region) {
  double worst_m = -1e9;
  for (double s_m = 0.0; s_m < spline.length_m(); s_m += 1.0) {
    const SplinePoint p = spline.at(s_m);
    const world::Curvilinear place = lanes.track().project(p.x_m, p.y_m);
    const Band free = lanes.band(region, place.s_m).narrowed(kMargin_m);
    worst_m = std::max({worst_m, place.n_m - free.left_m, free.right_m - place.n_m});
  }
  return worst_m;
}

TEST(Waypoints, ParallelOnesLieAtTheSidesOfTheirLane) {
  for (const auto& description : {stadium(), mirrored(stadium())}) {
    const world::TrackMap track = valid(world::TrackMap::build(description));
    const Lanes lanes{track};
    for (const Region region : {Region::kInnerLane, Region::kOuterLane}) {
      const auto inside = valid(parallel_waypoints(lanes, region, Side::kInside, kMargin_m));
      const auto centre = valid(parallel_waypoints(lanes, region, Side::kCentre, kMargin_m));
      const auto outside = valid(parallel_waypoints(lanes, region, Side::kOutside, kMargin_m));
      ASSERT_EQ(inside.size(), centre.size());
      const double inward = lanes.turns_left() ? 1.0 : -1.0;
      for (std::size_t i = 0; i < inside.size(); ++i) {
        const Band band = lanes.band(region, inside[i].s_m);
        EXPECT_NEAR(inward * (inside[i].n_m - band.middle_m()), 0.5 * band.width_m() - kMargin_m,
                    1e-9);
        EXPECT_NEAR(centre[i].n_m, band.middle_m(), 1e-9);
        EXPECT_NEAR(inward * (outside[i].n_m - band.middle_m()),
                    -(0.5 * band.width_m() - kMargin_m), 1e-9);
      }
    }
  }
}

// The stadium turns by 0.4 rad on 80 m of its turns: more waypoints there than on its straights.
TEST(Waypoints, AreCloserInTurns) {
  const world::TrackMap track = valid(world::TrackMap::build(stadium()));
  const auto points =
      valid(parallel_waypoints(Lanes{track}, Region::kInnerLane, Side::kCentre, kMargin_m));
  const auto between = [&](double from_m, double to_m) {
    return std::ranges::count_if(
        points, [&](const Waypoint& w) { return w.s_m >= from_m && w.s_m < to_m; });
  };
  EXPECT_GT(between(600.0, 1000.0), 3 * between(50.0, 450.0) / 2);
}

TEST(Waypoints, ANarrowLaneIsRefusedWithItsStation) {
  world::TrackDescription description = stadium();
  description.knots[2].width_left_m = 0.5;  // at s = 580 m
  description.knots[2].width_right_m = 1.5;
  const world::TrackMap track = valid(world::TrackMap::build(description));
  const auto refused =
      parallel_waypoints(Lanes{track}, Region::kOuterLane, Side::kInside, kMargin_m);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().place.substr(0, 14), "stadium: s = 5");
  EXPECT_NE(refused.error().what.find("the outer lane is"), std::string::npos);
  EXPECT_NE(refused.error().what.find("at least 2.60 m expected"), std::string::npos);
}

TEST(Waypoints, SplinesStayInTheirLane) {
  for (const auto& description : {stadium(), mirrored(stadium()), circuit()}) {
    const world::TrackMap track = valid(world::TrackMap::build(description));
    const Lanes lanes{track};
    for (const Region region : {Region::kInnerLane, Region::kOuterLane})
      for (const Side side : {Side::kInside, Side::kCentre, Side::kOutside}) {
        const auto points = valid(parallel_waypoints(lanes, region, side, kMargin_m));
        const SpiroSpline spline = valid(fit_between(lanes, region, kMargin_m, points));
        EXPECT_LT(excess_of(spline, lanes, region), kAllowed_m) << track.name();
      }
  }
}

// Through four points a spline is no stadium: it needs more of them to stay on its road.
TEST(Waypoints, AreAddedWhereASplineWouldLeaveItsLane) {
  const world::TrackMap track = valid(world::TrackMap::build(stadium()));
  const Lanes lanes{track};
  std::vector<Waypoint> few;
  for (const double share : {0.0, 0.25, 0.5, 0.75})
    few.push_back({share * track.length_m(),
                   lanes.band(Region::kInnerLane, share * track.length_m()).middle_m()});
  const SpiroSpline spline = valid(fit_between(lanes, Region::kInnerLane, kMargin_m, few));
  EXPECT_GT(spline.segments().size(), 4U);
  EXPECT_LT(excess_of(spline, lanes, Region::kInnerLane), kAllowed_m);
}

TEST(Waypoints, LeadThroughThePitLane) {
  for (const auto& description : {stadium(), mirrored(stadium())}) {
    const world::TrackMap track = valid(world::TrackMap::build(description));
    const Lanes lanes{track};
    const auto points = valid(pit_waypoints(lanes, kMargin_m));
    const SpiroSpline spline = valid(fit_between(lanes, Region::kPitLane, kMargin_m, points));
    EXPECT_LT(excess_of(spline, lanes, Region::kPitLane), kAllowed_m);
    double nearest_m = 1e9;
    for (double s_m = 0.0; s_m < spline.length_m(); s_m += 1.0) {
      const SplinePoint p = spline.at(s_m);
      const world::Curvilinear place = track.project(p.x_m, p.y_m);
      const auto along = lanes.along_pit(place.s_m);
      if (along && *along > 0.4 && *along < 0.6) {
        EXPECT_NEAR(place.n_m, track.pit()->offset_m, 0.5) << place.s_m;
      }
      if (!along) nearest_m = std::min(nearest_m, std::abs(track.pit()->offset_m - place.n_m));
    }
    EXPECT_GT(nearest_m, 6.0);  // beside the rest of the lap it is on the track
  }
}

}  // namespace
}  // namespace pitwall::raceline
