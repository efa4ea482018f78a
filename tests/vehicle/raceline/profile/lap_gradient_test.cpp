// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/profile/lap_gradient.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/vehicle/envelope/roads.hpp"

namespace pitwall::raceline {
namespace {

struct Laps {
  std::vector<RoadStep> road;
  envelope::EnvelopeTable table;
  std::vector<LapPoint> points{road.size()};

  double time(const std::vector<RoadStep>& at) {
    std::vector<LapPoint> lap(at.size());
    return LapProfile{table}.solve(at, lap).lap_s;
  }
  std::vector<LapSlope> gradient() {
    LapProfile{table}.solve(road, points);
    return lap_gradient(road, points, table);
  }
};

Laps car() {
  envelope::EnvelopeParams params = envelope::testing::av21_envelope();
  params.friction.engine.shift_s = 0.0;
  return {envelope::testing::lap(), envelope::EnvelopeTable{params}};
}

// A change of the curvature of twenty points at once, against the difference of two lap times.
// Where limits take over from each other within the change, both differ.
TEST(LapGradient, IsTheDifferenceOfLapTimes) {
  Laps laps = car();
  const auto slopes = laps.gradient();
  double worst = 0.0, largest = 0.0;
  for (std::size_t from = 0; from + 20 <= laps.road.size(); from += 20) {
    const double step = 1e-6;
    std::vector<RoadStep> low = laps.road, high = laps.road;
    double slope = 0.0;
    for (std::size_t i = from; i < from + 20; ++i) {
      high[i].curvature_per_m += step, low[i].curvature_per_m -= step;
      slope += slopes[i].by_curvature_s_m;
    }
    const double difference = (laps.time(high) - laps.time(low)) / (2.0 * step);
    worst = std::max(worst, std::abs(slope - difference));
    largest = std::max(largest, std::abs(difference));
  }
  EXPECT_GT(largest, 1.0);
  EXPECT_LT(worst, 0.05 * largest);
}

TEST(LapGradient, ByTheLengthOfASteps) {
  Laps laps = car();
  const auto slopes = laps.gradient();
  for (std::size_t i = 37; i < laps.road.size(); i += 101) {
    std::vector<RoadStep> low = laps.road, high = laps.road;
    const double step_m = 1e-4;
    high[i].step_m += step_m, low[i].step_m -= step_m;
    const double difference = (laps.time(high) - laps.time(low)) / (2.0 * step_m);
    EXPECT_NEAR(slopes[i].by_step_s_per_m, difference, 2e-3) << i;
  }
}

// In a corner that is driven at its speed all along: v = sqrt(a / k), t = s / v.
TEST(LapGradient, OfACircleIsTheTextbooks) {
  envelope::EnvelopeParams params = envelope::testing::block_envelope();
  Laps laps{std::vector<RoadStep>(400, RoadStep{0.02, 0.0, envelope::kNoCap_mps, 1.0}),
            envelope::EnvelopeTable{params}};
  const auto slopes = laps.gradient();
  double by_curvature = 0.0, by_step = 0.0;
  for (const LapSlope& slope : slopes)
    by_curvature += slope.by_curvature_s_m, by_step += slope.by_step_s_per_m;
  const double v = std::sqrt(2.5 * kGravity_mps2 / 0.02);
  EXPECT_NEAR(by_curvature, 0.5 * 400.0 / (v * 0.02), 0.01 * 400.0 / v / 0.02);
  EXPECT_NEAR(by_step / 400.0, 1.0 / v, 1e-4);
}

}  // namespace
}  // namespace pitwall::raceline
