// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/optimum/minimum_time.hpp"

#include <gtest/gtest.h>

#include "tests/vehicle/envelope/roads.hpp"
#include "tests/vehicle/raceline/courses.hpp"
#include "vehicle/raceline/optimum/minimum_curvature.hpp"
#include "vehicle/raceline/profile/lap_road.hpp"

namespace pitwall::raceline {
namespace {

double lap_of(const Lanes& lanes, const std::vector<Waypoint>& waypoints,
              const envelope::EnvelopeTable& table) {
  const auto spline = valid(fit_between(lanes, Region::kTrack, kMargin_m, waypoints));
  const Raceline line = sample_raceline(spline, lanes.track(), 1.0);
  const auto road = road_of(line, lanes);
  std::vector<LapPoint> lap(road.size());
  return LapProfile{table}.solve(road, lap).lap_s;
}

TEST(MinimumTime, IsFasterThanTheLineOfMinimumCurvatureAndThatThanTheCentre) {
  for (const auto& description : {circuit(), mirrored(circuit()), stadium()}) {
    const world::TrackMap track = valid(world::TrackMap::build(description));
    const Lanes lanes{track};
    const envelope::EnvelopeTable table{envelope::testing::av21_envelope()};
    const double fastest = lap_of(lanes, valid(minimum_time(lanes, kMargin_m, table)), table);
    const double straightest = lap_of(lanes, valid(minimum_curvature(lanes, kMargin_m)), table);
    const double centre = lap_of(
        lanes, valid(parallel_waypoints(lanes, Region::kTrack, Side::kCentre, kMargin_m)), table);
    EXPECT_LT(fastest, straightest) << track.name();
    EXPECT_LT(straightest, centre) << track.name();
  }
}

// A car that is flat out everywhere takes the shortest way.
TEST(MinimumTime, FlatOutIsTheInsideOfARing) {
  const world::TrackMap track = valid(world::TrackMap::build(ring()));
  envelope::EnvelopeParams slow = envelope::testing::av21_envelope();
  slow.speed_max_mps = 30.0;
  const Lanes lanes{track};
  for (const Waypoint& w : valid(minimum_time(lanes, kMargin_m, envelope::EnvelopeTable{slow})))
    EXPECT_NEAR(w.n_m, 8.0 - kMargin_m, 0.01) << w.s_m;
}

TEST(MinimumTime, RefusesANarrowTrack) {
  const world::TrackMap track = valid(world::TrackMap::build(ring()));
  EXPECT_FALSE(
      minimum_time(Lanes{track}, 8.5, envelope::EnvelopeTable{envelope::testing::av21_envelope()}));
}

}  // namespace
}  // namespace pitwall::raceline
