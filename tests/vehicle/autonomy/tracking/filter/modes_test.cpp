// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/modes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "vehicle/autonomy/tracking/filter/measurement.hpp"
#include "vehicle/autonomy/tracking/filter/motion.hpp"

namespace pitwall::tracking {
namespace {

Track with_two_modes() {
  Track t;
  t.x = {100.0, 3.0, 0.05, 60.0, 1.5, 0.04};
  for (std::size_t i = 0; i < kRoadStates; ++i) t.p[i][i] = 1.0 + 0.1 * static_cast<double>(i);
  begin_modes(RoadParams{}, t);
  t.modes.maneuver = 0.3;
  t.modes.apart = {0.5, -0.2, 0.01, 2.0, -3.0, 0.02};
  for (std::size_t i = 0; i < kRoadStates; ++i) t.modes.p[kManeuver][i][i] += 2.0;
  join_modes(t);
  return t;
}

TEST(Modes, OfATrackThatBeginsAreTheTrack) {
  Track t = with_two_modes();
  const StateMatrix before = t.p;
  begin_modes(RoadParams{}, t);
  join_modes(t);
  for (std::size_t i = 0; i < kRoadStates; ++i)
    for (std::size_t j = 0; j < kRoadStates; ++j) EXPECT_NEAR(t.p[i][j], before[i][j], 1e-14);
}

// Second moments about the mean, by hand: 0.7 * 1 + 0.3 * 3 + 0.3 * 0.7 * 0.5^2, and their product.
TEST(Modes, JoinedHaveTheDistanceBetweenThem) {
  const Track t = with_two_modes();
  EXPECT_NEAR(t.p[0][0], 1.6525, 1e-14);
  EXPECT_NEAR(t.p[0][1], -0.021, 1e-15);
  EXPECT_EQ(t.p[1][0], t.p[0][1]);
}

// Both modes seen as one: a change of the mode changes neither mean nor covariance.
TEST(Modes, MixingKeepsMeanAndCovariance) {
  Track t = with_two_modes();
  const StateMatrix before = t.p;
  mix_modes({.to_maneuver = 0.2, .to_steady = 0.3}, t.modes);
  EXPECT_NEAR(t.modes.maneuver, 0.7 * 0.3 + 0.2 * 0.7, 1e-15);
  join_modes(t);
  for (std::size_t i = 0; i < kRoadStates; ++i) {
    const double mean = (1.0 - t.modes.maneuver) * offset_of(t.modes, kSteady, i) +
                        t.modes.maneuver * offset_of(t.modes, kManeuver, i);
    EXPECT_NEAR(mean, 0.0, 1e-15);
    for (std::size_t j = 0; j < kRoadStates; ++j) EXPECT_NEAR(t.p[i][j], before[i][j], 1e-12);
  }
}

// Two steps in a row are one of their length; after a long time the mode is as likely as it lasts.
TEST(Modes, ChangeOfTwoStepsIsThatOfOne) {
  const RoadParams params;
  for (const double dt_s : {0.001, 0.05, 1.0, 20.0}) {
    const ModeChange half = mode_change(params, dt_s), one = mode_change(params, 2.0 * dt_s);
    const double after =
        (1.0 - half.to_steady) * half.to_maneuver + half.to_maneuver * (1.0 - half.to_maneuver);
    EXPECT_NEAR(after, one.to_maneuver, 1e-14) << dt_s;
  }
  const double share = params.maneuver_s / (params.maneuver_s + params.steady_s);
  EXPECT_NEAR(mode_change(params, 1e4).to_maneuver, share, 1e-12);
}

// Bayes' rule with the densities of scipy.stats.norm: w = 0.3, measured 1.2 m from x, sigma 0.4 m:
//   steady    norm.pdf(1.2, -0.15, sqrt(1.16)), maneuver norm.pdf(1.2, 0.35, sqrt(3.16))
TEST(Modes, BecomeAsLikelyAsTheyExpectedTheDetection) {
  Track t = with_two_modes();
  Expectation e;
  e.jacobian[0] = {1.0, 0.0, 0.0, 0.0};
  update(e, {.size = 1, .value = {1.2, 0.0, 0.0}, .variance = {0.16, 0.0, 0.0}}, nullptr, t);
  EXPECT_NEAR(t.modes.maneuver, 0.336901454528, 1e-9);
  EXPECT_NEAR(t.x[kAlong], 100.0 + 1.062026921469, 1e-9);
}

}  // namespace
}  // namespace pitwall::tracking
