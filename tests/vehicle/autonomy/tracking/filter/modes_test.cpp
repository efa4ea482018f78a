// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/modes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "vehicle/autonomy/tracking/filter/measurement.hpp"
#include "vehicle/autonomy/tracking/filter/motion.hpp"

namespace pitwall::tracking {
namespace {

Track with_modes() {
  Track t;
  t.x = {100.0, 3.0, 0.05, 60.0, 1.5, 0.04};
  for (std::size_t i = 0; i < kRoadStates; ++i) t.p[i][i] = 1.0 + 0.1 * static_cast<double>(i);
  begin_modes(RoadParams{}, t);
  t.modes.share = {0.6, 0.3, 0.1};
  t.modes.apart[kSpeedChange] = {0.5, -0.2, 0.01, 2.0, -3.0, 0.02};
  t.modes.apart[kLaneChange] = {-0.3, 0.6, 0.03, -1.0, 1.0, 0.05};
  for (std::size_t i = 0; i < kRoadStates; ++i) t.modes.p[kSpeedChange][i][i] += 2.0;
  centre_modes(t);
  join_modes(t);
  return t;
}

TEST(Modes, OfATrackThatBeginsAreTheTrack) {
  Track t = with_modes();
  const StateMatrix before = t.p;
  begin_modes(RoadParams{}, t);
  join_modes(t);
  for (std::size_t i = 0; i < kRoadStates; ++i)
    for (std::size_t j = 0; j < kRoadStates; ++j) EXPECT_NEAR(t.p[i][j], before[i][j], 1e-14);
}

// By hand: the mean is 0.3 * 0.5 - 0.1 * 0.3 = 0.12 m along, 0.3 * -0.2 + 0.1 * 0.6 = 0 across;
// The second moment about it: 0.7 * 1 + 0.3 * 3 + 0.3 * 0.5^2 + 0.1 * 0.3^2 - 0.12^2.
TEST(Modes, JoinedHaveTheDistanceBetweenThem) {
  const Track t = with_modes();
  EXPECT_NEAR(t.x[kAlong], 100.12, 1e-12);
  EXPECT_NEAR(t.x[kAcross], 3.0, 1e-12);
  EXPECT_NEAR(t.p[0][0], 1.6696, 1e-13);
  EXPECT_NEAR(t.p[0][1], -0.048, 1e-14);
  EXPECT_EQ(t.p[1][0], t.p[0][1]);
}

// All modes seen as one: a change of the mode changes neither mean nor covariance.
TEST(Modes, MixingKeepsMeanAndCovariance) {
  Track t = with_modes();
  const StateMatrix before = t.p;
  mix_modes({{{0.7, 0.2, 0.1}, {0.3, 0.7, 0.0}, {0.25, 0.05, 0.7}}}, t.modes);
  EXPECT_NEAR(t.modes.share[kSpeedChange], 0.2 * 0.6 + 0.7 * 0.3 + 0.05 * 0.1, 1e-15);
  join_modes(t);
  for (std::size_t i = 0; i < kRoadStates; ++i) {
    double mean = 0.0;
    for (std::size_t k = 0; k < kModes; ++k) mean += t.modes.share[k] * t.modes.apart[k][i];
    EXPECT_NEAR(mean, 0.0, 1e-15);
    for (std::size_t j = 0; j < kRoadStates; ++j) EXPECT_NEAR(t.p[i][j], before[i][j], 1e-12);
  }
}

// Two steps in a row are one of their length; after a long time a mode is as likely as it lasts,
// which is how a track begins.
TEST(Modes, ChangeOfTwoStepsIsThatOfOne) {
  const RoadParams params;
  for (const double dt_s : {0.001, 0.05, 1.0, 20.0}) {
    const ModeChange half = mode_change(params, dt_s), one = mode_change(params, 2.0 * dt_s);
    for (std::size_t from = 0; from < kModes; ++from)
      for (std::size_t to = 0; to < kModes; ++to) {
        double twice = 0.0;
        for (std::size_t by = 0; by < kModes; ++by) twice += half[from][by] * half[by][to];
        EXPECT_NEAR(twice, one[from][to], 1e-14) << dt_s << " " << from << to;
      }
  }
  Track begun;
  begin_modes(params, begun);
  EXPECT_NEAR(begun.modes.share[kSteady], params.steady_s / (params.maneuver_s + params.steady_s),
              1e-14);
  for (const auto& from : mode_change(params, 1e4))
    for (std::size_t to = 0; to < kModes; ++to)
      EXPECT_NEAR(from[to], begun.modes.share[to], 1e-12) << to;
}

// A car that has begun to brake may go on to do so; to change its lane it first ends that.
TEST(Modes, OneManeuverFollowsAnotherOnlyLater) {
  const ModeChange c = mode_change(RoadParams{}, 0.01);
  EXPECT_NEAR(c[kSpeedChange][kSteady], 0.01 / RoadParams{}.maneuver_s, 1e-5);
  EXPECT_LT(c[kSpeedChange][kLaneChange], 1e-6);
  EXPECT_GT(c[kSpeedChange][kLaneChange], 0.0);
}

// Bayes' rule with the densities of scipy.stats.norm, measured 1.2 m from x, sigma 0.4 m:
//   0.6 norm.pdf(1.2, -0.12, sqrt(1.16)), 0.3 norm.pdf(1.2, 0.38, sqrt(3.16)),
//   0.1 norm.pdf(1.2, -0.42, sqrt(1.16))
TEST(Modes, BecomeAsLikelyAsTheyExpectedTheDetection) {
  Track t = with_modes();
  const double x_m = t.x[kAlong];
  Expectation e;
  e.jacobian[0] = {1.0, 0.0, 0.0, 0.0};
  update(e, {.size = 1, .value = {1.2, 0.0, 0.0}, .variance = {0.16, 0.0, 0.0}}, nullptr, t);
  EXPECT_NEAR(t.modes.share[kSteady], 0.591314026534, 1e-9);
  EXPECT_NEAR(t.modes.share[kSpeedChange], 0.341301451909, 1e-9);
  EXPECT_NEAR(t.x[kAlong], x_m + 1.063112621070, 1e-9);
}

}  // namespace
}  // namespace pitwall::tracking
