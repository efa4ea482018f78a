// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/courses.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/vehicle/autonomy/tracking/filter/circle.hpp"
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
}

// By hand: 1.5 m/s for 1 s, and for 2 s at most; at 60 m/s it needs a heading of 0.025.
TEST(Courses, ACarThatChangesItsLaneIsFurtherAcross) {
  const Track t = unseen_track();
  for (const auto& [unseen_s, across_m] : {std::array{1.0, 1.5}, std::array{8.0, 3.0}}) {
    const RoadParams params{.unseen_lane_sigma_mps = 1.5, .unseen_lane_s = 2.0};
    const RoadMatrix p = courses_of(params, from_seconds(unseen_s), t).track[kOtherLane].modes.p[0];
    EXPECT_NEAR(p[kAcross][kAcross], t.p[kAcross][kAcross] + across_m * across_m, 1e-9);
    EXPECT_NEAR(p[kHeading][kHeading], t.p[kHeading][kHeading] + 0.025 * 0.025, 1e-12);
  }
}

TEST(Courses, ProbabilitiesAreThoseOfAllTogether) {
  const Courses c = courses_of(RoadParams{}, seconds(1), unseen_track());
  double sum = 0.0;
  for (const double cost : c.cost) sum += std::exp(-0.5 * cost);
  EXPECT_NEAR(sum, 1.0, 1e-12);
}

// The likelihood against the sum of three normal densities, written out: of a track whose states
// are all known well, the covariance of the lost one has two pairs of states that depend on each
// other (along and across, along and speed), and three more.
TEST(Courses, FitIsTheSumOfTheDensities) {
  Track lost = unseen_track();
  lost.p[kAlong][kAcross] = lost.p[kAcross][kAlong] = 0.0;
  begin_modes(RoadParams{}, lost);
  const Courses c = courses_of(RoadParams{}, seconds(3), lost);
  for (const double away_m : {0.2, 12.0, 40.0}) {
    Track seen = lost;
    seen.x[kAlong] += away_m, seen.x[kSpeed] += 0.3 * away_m;
    seen.p = {};
    for (std::size_t i = 0; i < kRoadStates; ++i) seen.p[i][i] = 0.04;
    const CourseFit fit = course_fit(c, nullptr, seen);
    double sum = 0.0, last_square = 0.0;
    for (std::size_t k = 0; k < kCourses; ++k) {
      const StateMatrix& p = c.track[k].p;
      const double a = p[kAlong][kAlong] + 0.04, b = p[kSpeed][kSpeed] + 0.04,
                   ab = p[kAlong][kSpeed];
      double det = a * b - ab * ab;
      last_square = away_m * away_m * (b - 2.0 * 0.3 * ab + 0.3 * 0.3 * a) / det;
      for (const std::size_t i : {kAcross, kHeading, kAccel, kTurn}) det *= p[i][i] + 0.04;
      sum += std::exp(-0.5 * (c.cost[k] + last_square)) / std::sqrt(det);
    }
    EXPECT_NEAR(fit.cost, -2.0 * std::log(sum), 1e-9) << away_m;
    EXPECT_NEAR(fit.square, last_square, 1e-9) << away_m;
    EXPECT_EQ(fit.best == kAsBefore, away_m < 1.0) << away_m;
  }
}

// Around the end of a lap and around half a turn.
TEST(Courses, DifferenceIsTheShortWay) {
  const world::TrackMap map = testing::circle();
  Track from = unseen_track(), to = from;
  from.x[kAlong] = map.length_m() - 3.0, to.x[kAlong] = 4.0;
  from.x[kHeading] = 3.1, to.x[kHeading] = -3.1;
  const RoadVector d = difference_of(&map, from, to);
  EXPECT_NEAR(d[kAlong], 7.0, 1e-9);
  EXPECT_NEAR(d[kHeading], 2.0 * std::numbers::pi - 6.2, 1e-12);
  EXPECT_EQ(d[kSpeed], 0.0);
}

}  // namespace
}  // namespace pitwall::tracking
