// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/courses.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "vehicle/autonomy/tracking/filter/modes.hpp"
#include "vehicle/autonomy/tracking/filter/motion.hpp"

namespace pitwall::tracking {
namespace {

Track unseen_track() {
  Track t;
  t.x = {100.0, 3.0, 0.0, 60.0, 0.0, 0.0};
  for (std::size_t i = 0; i < kRoadStates; ++i) t.p[i][i] = 1.0 + 0.1 * static_cast<double>(i);
  t.p[kAlong][kAcross] = t.p[kAcross][kAlong] = 0.4;
  begin_modes(RoadParams{}, t);
  join_modes(t);
  return t;
}

// By hand: 2.5 m/s^2 for 2 s are 5 m/s and 5 m; for 3 s, and 2 s on, 7.5 m/s and 26.25 m.
TEST(Courses, AnAccelerationMovesTheCarAndItsSpeed) {
  const Track t = unseen_track();
  for (const auto& [unseen_s, speed, along] :
       {std::array{2.0, 5.0, 5.0}, std::array{5.0, 7.5, 26.25}}) {
    const Courses c = courses_of(RoadParams{}, from_seconds(unseen_s), t);
    for (const std::size_t i : {kOtherSpeed, kOtherLane}) {
      EXPECT_NEAR(c.track[i].p[kAlong][kAlong], t.p[kAlong][kAlong] + along * along, 1e-9);
      EXPECT_NEAR(c.track[i].p[kSpeed][kSpeed], t.p[kSpeed][kSpeed] + speed * speed, 1e-9);
      EXPECT_NEAR(c.track[i].p[kAlong][kSpeed], along * speed, 1e-9);
      EXPECT_EQ(c.track[i].p[kSpeed][kAlong], c.track[i].p[kAlong][kSpeed]);
    }
    EXPECT_NEAR(c.track[kAsBefore].p[kAlong][kAlong], t.p[kAlong][kAlong], 1e-12);
  }
}

TEST(Courses, ACarThatKeepsItsLaneIsLessFarAcross) {
  const Track t = unseen_track();
  const Courses c = courses_of(RoadParams{.lane_sigma_share = 0.5}, seconds(2), t);
  for (const std::size_t i : {kAsBefore, kOtherSpeed}) {
    EXPECT_NEAR(c.track[i].p[kAcross][kAcross], 0.25 * t.p[kAcross][kAcross], 1e-12);
    EXPECT_NEAR(c.track[i].p[kAlong][kAcross], 0.5 * t.p[kAlong][kAcross], 1e-12);
  }
  EXPECT_NEAR(c.track[kOtherLane].p[kAcross][kAcross], t.p[kAcross][kAcross], 1e-12);
}

TEST(Courses, ProbabilitiesAreThoseOfAllTogether) {
  const Courses c = courses_of(RoadParams{}, seconds(1), unseen_track());
  double sum = 0.0;
  for (const double cost : c.cost) sum += std::exp(-0.5 * cost);
  EXPECT_NEAR(sum, 1.0, 1e-12);
}

// The likelihood against the sum of three normal densities of one value, written out.
TEST(Courses, FitIsTheSumOfTheDensities) {
  const Courses c = courses_of(RoadParams{}, seconds(3), unseen_track());
  Expectation e;
  e.jacobian[0] = {1.0, 0.0, 0.0, 0.0};
  for (const double away_m : {0.5, 6.0, 20.0}) {
    const CourseFit fit =
        course_fit(c, e, {.size = 1, .value = {away_m, 0.0, 0.0}, .variance = {0.04, 0.0, 0.0}});
    double sum = 0.0;
    for (std::size_t i = 0; i < kCourses; ++i) {
      const double variance = c.track[i].p[kAlong][kAlong] + 0.04;
      sum += std::exp(-0.5 * (c.cost[i] + away_m * away_m / variance)) / std::sqrt(variance);
    }
    EXPECT_NEAR(fit.cost, -2.0 * std::log(sum), 1e-9);
    EXPECT_NEAR(fit.square, away_m * away_m / (c.track[kOtherLane].p[kAlong][kAlong] + 0.04),
                1e-12);
    EXPECT_EQ(fit.best == kAsBefore, away_m < 1.0);
  }
}

}  // namespace
}  // namespace pitwall::tracking
