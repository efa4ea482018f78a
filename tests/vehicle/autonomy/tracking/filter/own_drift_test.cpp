// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/own_drift.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/autonomy/tracking/filter/circle.hpp"
#include "vehicle/autonomy/tracking/filter/modes.hpp"
#include "vehicle/autonomy/tracking/filter/motion.hpp"

namespace pitwall::tracking {
namespace {

using testing::circle;

// In Map, from the states' covariance: what a turn and a shift of our car move the other one by.
TEST(OwnDrift, IsThatOfAShiftAndATurnOfOurCar) {
  const world::TrackMap map = circle();
  RoadParams params;
  params.own_drift_m_per_sqrt_s = 0.02, params.own_yaw_drift_rad_per_sqrt_s = 0.001;
  constexpr double kAfter_s = 0.5;
  Track track;
  track.x = {300.0, 4.0, 0.02, 60.0, 0.0, 0.0};
  begin_modes(params, track);
  const Place place = place_of(&map, track.x);
  const OwnMotion own{.x_m = place.x_m - 30.0, .y_m = place.y_m + 12.0};
  add_own_drift(params, own, place, kAfter_s, track.modes);
  join_modes(track);
  const double turn = 1e-6 * kAfter_s, shift = 4e-4 * kAfter_s;
  // Place by our turn: the line of sight, turned left; then the heading.
  const std::array<double, 3> by{12.0, 30.0, 1.0};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      double got = 0.0;
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < 3; ++l)
          got += place.jacobian[i][k] * track.p[k][l] * place.jacobian[j][l];
      double expected = turn * by[i] * by[j];
      if (i == j && i < 2) expected += shift;
      // Off by the road's bend within the shift, which is the same in both axes only on a straight.
      EXPECT_NEAR(got, expected, 0.03 * turn * 30.0 * 30.0) << i << j;
    }
}

TEST(OwnDrift, IsTheSameForAllModesAndNoneWithoutTime) {
  const RoadParams params;
  Track track;
  track.x = {80.0, 10.0, 0.1, 60.0, 0.0, 0.0};
  begin_modes(params, track);
  const OwnMotion own{.x_m = 0.0, .y_m = 0.0};
  const Place place = place_of(nullptr, track.x);
  add_own_drift(params, own, place, 0.0, track.modes);
  for (const RoadMatrix& p : track.modes.p) EXPECT_EQ(p, RoadMatrix{});
  add_own_drift(params, own, place, 0.1, track.modes);
  // 80 m ahead our yaw counts 8 times as much across the sight as it does along it, 10 m aside.
  const RoadMatrix& first = track.modes.p[kSteady];
  const double shift = 0.1 * params.own_drift_m_per_sqrt_s * params.own_drift_m_per_sqrt_s;
  EXPECT_NEAR(first[kAcross][kAcross] - shift, 64.0 * (first[kAlong][kAlong] - shift), 1e-12);
  EXPECT_GT(first[kAcross][kAcross], shift);
  for (const RoadMatrix& p : track.modes.p) EXPECT_EQ(p, first);
}

}  // namespace
}  // namespace pitwall::tracking
