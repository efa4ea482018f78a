// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/measurement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/autonomy/tracking/filter/circle.hpp"
#include "vehicle/autonomy/tracking/filter/modes.hpp"

namespace pitwall::tracking {
namespace {

using testing::circle;
using testing::measured;
using testing::on_circle;
using testing::own_motion;
using testing::seen;
using testing::TruePose;
using world::DetectionSource;

constexpr std::array kAll{DetectionSource::kLidar, DetectionSource::kCamera,
                          DetectionSource::kRadar};
const TruePose kOwn = on_circle(200.0, -2.0, 0.02, 55.0);

StateVector state_at(double s_m, double n_m) { return {s_m, n_m, 0.07, 62.0, 1.0, 0.01}; }

std::size_t values_of(DetectionSource source) { return source == DetectionSource::kCamera ? 2 : 3; }

// Every sensor, on a map and on a plane: the Jacobian against central differences.
TEST(TrackMeasurement, JacobiansAreThoseOfDifferences) {
  const world::TrackMap map = circle();
  const OwnMotion own = own_motion(kOwn);
  for (const world::TrackMap* ground : {&map, static_cast<const world::TrackMap*>(nullptr)})
    for (const DetectionSource source : kAll) {
      const StateVector x = ground != nullptr ? state_at(240.0, 4.0) : state_at(210.0, 150.0);
      const Expectation e = expectation_of(source, own, place_of(ground, x));
      for (std::size_t j = 0; j < 4; ++j) {
        constexpr double kStep = 1e-4;
        StateVector more = x, less = x;
        more[j] += kStep, less[j] -= kStep;
        const Expectation a = expectation_of(source, own, place_of(ground, more));
        const Expectation b = expectation_of(source, own, place_of(ground, less));
        for (std::size_t i = 0; i < values_of(source); ++i)
          EXPECT_NEAR(e.jacobian[i][j], (a.value[i] - b.value[i]) / (2.0 * kStep), 1e-6)
              << static_cast<int>(source) << " " << i << j;
      }
    }
}

// What a sensor measures of a car, from the closed form, is what is expected of its track.
TEST(TrackMeasurement, ExpectsWhatIsMeasured) {
  const world::TrackMap map = circle();
  const OwnMotion own = own_motion(kOwn);
  const StateVector x = state_at(290.0, 3.5);
  const TruePose car = on_circle(x[kAlong], x[kAcross], x[kHeading], x[kSpeed]);
  for (const DetectionSource source : kAll) {
    const Measurement m = measured(source, seen(source, kOwn, car));
    const Expectation e = expectation_of(source, own, place_of(&map, x));
    const Innovation in =
        innovation_of(source, reading_of(RoadParams{}, {.source = source}, own, m), e);
    ASSERT_EQ(in.size, values_of(source));
    for (std::size_t i = 0; i < in.size; ++i) EXPECT_NEAR(in.value[i], 0.0, 1e-6) << i;
    const Position at = position_of(source, own, m);
    EXPECT_NEAR(at.x_m, car.x_m, 1e-9);
    EXPECT_NEAR(at.y_m, car.y_m, 1e-9);
    EXPECT_NEAR(station_of(map, own, at).s_m, x[kAlong], 1e-5);
    EXPECT_NEAR(station_of(map, own, at).n_m, x[kAcross], 1e-5);
  }
}

// The nearest way along a closed road.
TEST(TrackMeasurement, WayIsTheShorterOne) {
  const world::TrackMap map = circle();
  EXPECT_NEAR(way_m(&map, map.length_m() - 5.0, 7.0), 12.0, 1e-9);
  EXPECT_NEAR(way_m(&map, 7.0, map.length_m() - 5.0), -12.0, 1e-9);
  EXPECT_EQ(way_m(nullptr, 7.0, 1e4), 1e4 - 7.0);
}

TEST(TrackMeasurement, TurnedBoxIsTheSameBox) {
  const OwnMotion own = own_motion(kOwn);
  const TruePose car = on_circle(240.0, 3.0, 0.0, 60.0);
  Measurement m = measured(DetectionSource::kLidar, seen(DetectionSource::kLidar, kOwn, car));
  const Expectation e{.value = {car.x_m, car.y_m, car.yaw_rad}};
  m.value[2] += std::numbers::pi;
  const Innovation in =
      innovation_of(DetectionSource::kLidar,
                    reading_of(RoadParams{}, {.source = DetectionSource::kLidar}, own, m), e);
  EXPECT_NEAR(in.value[2], 0.0, 1e-12);
}

TEST(TrackMeasurement, MissingValuesLeaveFewer) {
  const OwnMotion own = own_motion(kOwn);
  const auto size = [&](DetectionSource source, std::array<double, 5> values) {
    return reading_of(RoadParams{}, {.source = source}, own, {values, 1.0}).size;
  };
  EXPECT_EQ(size(DetectionSource::kCamera, {0.1, kUnset, kUnset, kUnset, kUnset}), 1U);
  EXPECT_EQ(size(DetectionSource::kRadar, {40.0, 0.1, kUnset, kUnset, kUnset}), 2U);
  EXPECT_EQ(size(DetectionSource::kLidar, {40.0, 0.1, kUnset, kUnset, kUnset}), 2U);
}

// By hand: H P H' of the mode, and the square of what it is apart from the track.
TEST(TrackMeasurement, SpreadIsThatOfOneMode) {
  Modes modes;
  modes.p[kLaneChange][kAlong] = {4.0, 1.0};
  modes.p[kLaneChange][kAcross] = {1.0, 2.0};
  modes.p[kLaneChange][kTurn][kTurn] = 100.0;  // is not measured
  modes.apart[kLaneChange] = {0.5, -1.0};
  Expectation e;
  e.jacobian[0] = {1.0, 0.0, 0.0, 0.0};
  e.jacobian[1] = {2.0, 1.0, 0.0, 0.0};
  const Spread spread = spread_of(e, kLaneChange, modes);
  EXPECT_NEAR(spread[0][0], 4.0 + 0.25, 1e-14);
  EXPECT_NEAR(spread[0][1], 2.0 * 4.0 + 1.0 + 0.5 * (2.0 * 0.5 - 1.0), 1e-14);
  EXPECT_EQ(spread[1][0], spread[0][1]);
  EXPECT_NEAR(spread[1][1], 4.0 * 4.0 + 2.0 * 2.0 * 1.0 + 2.0, 1e-14);
}

// Against the two-dimensional formulas written out: inverse and determinant by hand.
TEST(TrackMeasurement, DistanceIsThatOfTheInverse) {
  const Spread spread{{{4.0, 1.5, 0.0}, {1.5, 3.0, 0.0}, {0.0, 0.0, 1.0}}};
  Innovation in{.size = 2, .value = {1.0, -2.0, 0.0}, .variance = {0.5, 0.25, 0.0}};
  const double a = 4.5, b = 1.5, d = 3.25, det = a * d - b * b;
  const double square = (d * 1.0 + 2.0 * b * 2.0 + a * 4.0) / det;
  const Distance distance = distance_of(spread, in, 1e6);
  EXPECT_NEAR(distance.square, square, 1e-12);
  EXPECT_NEAR(distance.log_det, std::log(det), 1e-12);
  in.value = {1e3, 0.0, 0.0};
  EXPECT_TRUE(std::isinf(distance_of(spread, in, 16.0).square));
  in.value = {kUnset, 0.0, 0.0};
  EXPECT_TRUE(std::isinf(distance_of(spread, in, 16.0).square));
}

// An update in information form, (P^-1 + H' R^-1 H)^-1: for one value it is a rank-one formula that
// is written here for itself.
TEST(TrackMeasurement, UpdateIsThatOfTheFormulaForOneValue) {
  Track track;
  track.x = {10.0, 2.0, 0.1, 50.0, 0.0, 0.0};
  for (std::size_t i = 0; i < kRoadStates; ++i) track.p[i][i] = 2.0 + static_cast<double>(i);
  track.p[0][3] = track.p[3][0] = 0.7;
  Expectation e;
  e.jacobian[0] = {0.6, -0.8, 0.0, 0.3};
  begin_modes(RoadParams{}, track);
  const Track before = track;
  update(e, {.size = 1, .value = {1.5, 0, 0}, .variance = {0.2, 0, 0}}, nullptr, track);
  join_modes(track);
  std::array<double, kRoadStates> ph{};
  for (std::size_t i = 0; i < kRoadStates; ++i)
    for (std::size_t k = 0; k < 4; ++k) ph[i] += before.p[i][k] * e.jacobian[0][k];
  double s = 0.2;
  for (std::size_t k = 0; k < 4; ++k) s += e.jacobian[0][k] * ph[k];
  for (std::size_t i = 0; i < kRoadStates; ++i) {
    EXPECT_NEAR(track.x[i], before.x[i] + ph[i] * 1.5 / s, 1e-12);
    for (std::size_t j = 0; j < kRoadStates; ++j)
      EXPECT_NEAR(track.p[i][j], before.p[i][j] - ph[i] * ph[j] / s, 1e-12);
  }
}

// The noise of a depth grows with its square: that of its inverse does not.
TEST(TrackMeasurement, CameraDepthIsWorseFarAway) {
  const RoadParams params;
  const SightSigma near = sight_sigma(params, {.source = DetectionSource::kCamera}, {}, 50.0);
  const SightSigma far = sight_sigma(params, {.source = DetectionSource::kCamera}, {}, 100.0);
  EXPECT_NEAR(far.along_m / near.along_m, 4.0, 1e-12);
  EXPECT_NEAR(far.across_m / near.across_m, 2.0, 1e-12);
}

// A detector that knows how far it is off says so with each car.
TEST(TrackMeasurement, TheDetectorsOwnSigmasComeBeforeThoseOfTheUnit) {
  const RoadParams params;
  const Measurement own{{0.1, 1.0 / 40.0, 0.002, 0.08, kUnset}, 0.9};
  const SightSigma sigma = sight_sigma(params, {.source = DetectionSource::kCamera}, own, 40.0);
  EXPECT_NEAR(sigma.along_m, 0.08 * 40.0, 1e-12);
  EXPECT_NEAR(sigma.across_m, 0.002 * 40.0, 1e-12);
  const Innovation reading = reading_of(params, {.source = DetectionSource::kCamera}, {}, own);
  EXPECT_NEAR(std::sqrt(reading.variance[0]), 0.002, 1e-12);
  EXPECT_NEAR(std::sqrt(reading.variance[1]), 0.08 / 40.0, 1e-12);
  const Measurement plain{{0.1, 1.0 / 40.0, kUnset, kUnset, kUnset}, 0.9};
  EXPECT_NEAR(
      std::sqrt(reading_of(params, {.source = DetectionSource::kCamera}, {}, plain).variance[0]),
      params.camera_bearing_sigma_rad, 1e-12);
}

}  // namespace
}  // namespace pitwall::tracking
