// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/autonomy/tracking/filter/circle.hpp"

namespace pitwall::tracking {
namespace {

using testing::circle;
using testing::kRadius_m;

Track moving(double speed_mps) {
  Track t;
  t.x = {100.0, 3.0, 0.05, speed_mps, 1.5, 0.04};
  for (std::size_t i = 0; i < kRoadStates; ++i) {
    for (std::size_t j = 0; j < kRoadStates; ++j)
      t.p[i][j] = 0.01 * std::cos(1.0 + static_cast<double>(i * j));
    t.p[i][i] = 1.0 + 0.1 * static_cast<double>(i);
  }
  for (std::size_t i = 0; i < kRoadStates; ++i)
    for (std::size_t j = 0; j < i; ++j) t.p[i][j] = t.p[j][i];
  begin_modes(RoadParams{}, t);
  return t;
}

RoadParams without_noise() {
  RoadParams p;
  p.steady_accel_sigma_mps2 = p.accel_sigma_mps2 = p.steady_turn_sigma_rad_per_s =
      p.speed_change_turn_sigma_rad_per_s = p.turn_sigma_rad_per_s = p.plane_turn_sigma_rad_per_s =
          0.0;
  p.wander_m_per_sqrt_s = p.heading_wander_rad_per_sqrt_s = 0.0;
  return p;
}

// Central differences of the states of a mode after a step, by those before it.
std::array<std::array<double, kRoadStates>, kRoadStates> differences(const MotionStep& step,
                                                                     std::size_t mode,
                                                                     double curvature_per_m,
                                                                     const StateVector& x) {
  std::array<std::array<double, kRoadStates>, kRoadStates> f{};
  for (std::size_t j = 0; j < kRoadStates; ++j) {
    constexpr double kStep = 1e-5;
    StateVector more = x, less = x;
    more[j] += kStep, less[j] -= kStep;
    const StateVector a = advanced(step, mode, curvature_per_m, more).x;
    const StateVector b = advanced(step, mode, curvature_per_m, less).x;
    for (std::size_t i = 0; i < kRoadStates; ++i) f[i][j] = (a[i] - b[i]) / (2.0 * kStep);
  }
  return f;
}

TEST(Motion, JacobianIsThatOfDifferences) {
  for (const double curvature_per_m : {0.0, 1.0 / kRadius_m, -1.0 / 80.0})
    for (const double dt_s : {0.001, 0.05, 0.1})
      for (const double speed_mps : {-3.0, 0.0, 30.0, 85.0}) {
        const std::size_t mode = speed_mps > 0.0 ? kSteady : kSpeedChange;
        const MotionStep step = motion_step(RoadParams{}, true, dt_s);
        const StateVector x = moving(speed_mps).x;
        const auto expected = differences(step, mode, curvature_per_m, x);
        const Advance a = advanced(step, mode, curvature_per_m, x);
        for (std::size_t i = 0; i < 2; ++i)
          for (std::size_t j = 0; j < kRoadStates; ++j)
            EXPECT_NEAR(a.jacobian[i][j], expected[i][j], 1e-7) << i << j << " " << speed_mps;
      }
}

// The sparse product in the filter against F P F' in full.
TEST(Motion, CovarianceIsMovedByTheJacobian) {
  const world::TrackMap map = circle();
  RoadParams params = without_noise();
  params.accel_time_s = params.steady_accel_time_s;  // all modes are one
  Track track = moving(60.0);
  const MotionStep step = motion_step(params, true, 0.08);
  const auto f = differences(step, kLaneChange, 1.0 / kRadius_m, track.x);
  const StateMatrix before = track.p;
  coast(params, &map, milliseconds(80), track);
  for (std::size_t i = 0; i < kRoadStates; ++i)
    for (std::size_t j = 0; j < kRoadStates; ++j) {
      double expected = 0.0;
      for (std::size_t k = 0; k < kRoadStates; ++k)
        for (std::size_t l = 0; l < kRoadStates; ++l) expected += f[i][k] * before[k][l] * f[j][l];
      EXPECT_NEAR(track.p[i][j], expected, 1e-6 * (1.0 + std::abs(expected))) << i << j;
    }
}

// A steady car that brakes keeps more of that than one that may end it soon; the track is their
// mean.
TEST(Motion, ModesForgetTheAccelerationEachInItsTime) {
  const RoadParams params = without_noise();
  Track track;
  track.x = {0.0, 0.0, 0.0, 60.0, -3.0, 0.0};
  begin_modes(params, track);
  const std::array<double, kModes> share = track.modes.share;
  coast(params, nullptr, milliseconds(100), track);
  const double steady = -3.0 * std::exp(-0.1 / params.steady_accel_time_s);
  const double changing = -3.0 * std::exp(-0.1 / params.accel_time_s);
  EXPECT_NEAR(track.x[kAccel], share[kSteady] * steady + (1.0 - share[kSteady]) * changing, 1e-12);
  EXPECT_NEAR(track.x[kAccel] + track.modes.apart[kSteady][kAccel], steady, 1e-12);
  EXPECT_NEAR(track.x[kAccel] + track.modes.apart[kLaneChange][kAccel], changing, 1e-12);
}

// Noise of two steps in a row is that of one of their length (Chapman-Kolmogorov), on both sides of
// the change from the series to the closed form; after a long time it is that of the process.
TEST(Motion, NoiseOfTwoStepsIsThatOfOne) {
  constexpr double kSigma = 3.0, kTime_s = 2.0;
  for (const double dt_s : {1e-4, 0.019, 0.03, 0.05, 0.3, 4.0}) {
    const Fading half = fading(kSigma, kTime_s, dt_s), one = fading(kSigma, kTime_s, 2.0 * dt_s);
    const double value = half.kept * half.kept * half.value_variance + half.value_variance;
    const double covariance =
        half.kept * (half.covariance + half.gain_s * half.value_variance) + half.covariance;
    const double integral = 2.0 * half.integral_variance + 2.0 * half.gain_s * half.covariance +
                            half.gain_s * half.gain_s * half.value_variance;
    EXPECT_NEAR(value, one.value_variance, 1e-10 * one.value_variance) << dt_s;
    EXPECT_NEAR(covariance, one.covariance, 1e-9 * one.covariance) << dt_s;
    EXPECT_NEAR(integral, one.integral_variance, 1e-7 * one.integral_variance) << dt_s;
    EXPECT_NEAR(half.kept * half.kept, one.kept, 1e-14);
    EXPECT_NEAR(half.gain_s, one.half_s, 1e-15);
  }
  EXPECT_NEAR(fading(kSigma, kTime_s, 200.0).value_variance, kSigma * kSigma, 1e-9);
}

// A car that drives round the circle at a constant offset, seen from nowhere, is where it must be.
TEST(Motion, FollowsTheRoadForFiveSeconds) {
  const world::TrackMap map = circle();
  Track track;
  track.x = {1500.0, -4.0, 0.0, 70.0, 0.0, 0.0};
  begin_modes(RoadParams{}, track);
  coast(RoadParams{}, &map, seconds(5), track);
  const double way_m = 5.0 * 70.0 / (1.0 + 4.0 / kRadius_m);
  EXPECT_NEAR(track.x[kAlong], map.wrap_station(1500.0 + way_m), 1e-6);
  EXPECT_NEAR(track.x[kAcross], -4.0, 1e-12);
}

// A car that crosses the road comes back to its direction; on a plane there is none.
TEST(Motion, HeadingComesBackToTheRoad) {
  const world::TrackMap map = circle();
  const RoadParams params;
  constexpr double kHeading_rad = 0.03;
  for (const world::TrackMap* ground : {&map, static_cast<const world::TrackMap*>(nullptr)}) {
    Track track;
    track.x = {1500.0, 0.0, kHeading_rad, 60.0, 0.0, 0.0};
    begin_modes(params, track);
    coast(params, ground, from_seconds(params.heading_time_s), track);
    const double left = ground != nullptr ? std::exp(-1.0) : 1.0;
    EXPECT_NEAR(track.x[kHeading], left * kHeading_rad, 1e-12);
  }
}

// On a plane a car turns on the circle of its turn rate while that is not forgotten.
TEST(Motion, TurnsOnAPlane) {
  RoadParams params = without_noise();
  params.plane_turn_time_s = 1e6;
  Track track;
  constexpr double kTurn_rad_per_s = 0.25, kSpeed_mps = 50.0;
  track.x = {0.0, 0.0, 0.0, kSpeed_mps, 0.0, kTurn_rad_per_s};
  begin_modes(params, track);
  coast(params, nullptr, seconds(2), track);
  const double r_m = kSpeed_mps / kTurn_rad_per_s, turned_rad = 2.0 * kTurn_rad_per_s;
  // The midpoint rule is off by (turn dt)^2 / 24 of the way.
  constexpr double kWay_m = 100.0, kShare = 0.025 * 0.025 / 24.0;
  EXPECT_NEAR(track.x[0], r_m * std::sin(turned_rad), kShare * kWay_m);
  EXPECT_NEAR(track.x[1], r_m * (1.0 - std::cos(turned_rad)), kShare * kWay_m);
  EXPECT_NEAR(track.x[2], turned_rad, 1e-6);
}

TEST(Motion, CoastingCovarianceGrows) {
  const world::TrackMap map = circle();
  Track track = moving(60.0);
  double before_m2 = 0.0;
  for (int i = 0; i < 20; ++i) {
    coast(RoadParams{}, &map, milliseconds(250), track);
    EXPECT_GT(track.p[kAlong][kAlong], before_m2);
    before_m2 = track.p[kAlong][kAlong];
  }
}

TEST(Motion, CurvatureIsThatOfTheMap) {
  const world::TrackMap map = circle();
  for (const double s_m : {-3.0, 0.0, 0.5, 777.7, map.length_m() - 1e-9, map.length_m()})
    EXPECT_NEAR(curvature_at(&map, s_m), map.at(s_m).curvature_per_m, 1e-6) << s_m;
  EXPECT_EQ(curvature_at(nullptr, 5.0), 0.0);
}

}  // namespace
}  // namespace pitwall::tracking
