// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/profile/lap_check.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "tests/vehicle/envelope/roads.hpp"

namespace pitwall::raceline {
namespace {

struct Course {
  std::vector<RoadStep> road = envelope::testing::lap();
  envelope::EnvelopeTable table{envelope::testing::av21_envelope()};
  Raceline line = [this] {
    Raceline l{"lap",
               Region::kTrack,
               2400.0,
               std::vector<RacelinePoint>(road.size()),
               std::vector<LapPoint>(road.size()),
               kUnset};
    l.lap_s = LapProfile{table}.solve(road, l.lap).lap_s;
    return l;
  }();

  std::string refusal_of(const std::function<void(Raceline&)>& change) const {
    Raceline changed = line;
    change(changed);
    const auto figures = check_lap(changed, road, table);
    return figures ? "" : to_string(figures.error());
  }
  void expect(const std::function<void(Raceline&)>& change, const std::string& part) const {
    const std::string refusal = refusal_of(change);
    EXPECT_NE(refusal.find(part), std::string::npos) << refusal << " has no " << part;
  }
};

TEST(LapCheck, TakesWhatTheSolverMakes) {
  const Course course;
  const auto figures = check_lap(course.line, course.road, course.table);
  ASSERT_TRUE(figures) << to_string(figures.error());
  EXPECT_EQ(figures->lap_s, course.line.lap_s);
  EXPECT_NEAR(figures->speed_least.s_m, 460.0, 30.0);  // the corner of 30 m
  EXPECT_GT(figures->speed_most.value, 60.0);
  EXPECT_NEAR(figures->lateral_use_most.value, 1.0, 1e-6);
}

TEST(LapCheck, RefusesSpeedsThatTheTyresDoNotCarry) {
  const Course course;
  course.expect([](Raceline& l) { l.lap[460].speed_mps += 0.05; },
                "lap: s = 460.0 m: error: a speed of ");
  course.expect([](Raceline& l) { l.lap[460].speed_mps += 0.05; }, " m/s2 across the road");
}

TEST(LapCheck, RefusesWhatTheEngineOrTheBrakesDoNotHave) {
  const Course course;
  // All later speeds stay as they are: only the step to the changed point is too steep.
  course.expect(
      [](Raceline& l) {
        l.lap[600].speed_mps += 0.05;
        for (const std::size_t i : {599UL, 600UL}) {
          const double v = l.lap[i].speed_mps, next = l.lap[i + 1].speed_mps;
          l.lap[i].accel_mps2 = 0.5 * (next * next - v * v);
        }
      },
      "lap: s = 599.0 m: error: an acceleration of ");
  std::size_t braking = 0;
  while (course.line.lap[braking].accel_mps2 > -3.0) ++braking;
  course.expect(
      [&](Raceline& l) {
        l.lap[braking + 3].speed_mps += 0.05;
        for (const std::size_t i : {braking + 2, braking + 3}) {
          const double v = l.lap[i].speed_mps, next = l.lap[i + 1].speed_mps;
          l.lap[i].accel_mps2 = 0.5 * (next * next - v * v);
        }
      },
      "error: a deceleration of ");
}

TEST(LapCheck, RefusesWhatDoesNotBelongTogether) {
  const Course course;
  course.expect([](Raceline& l) { l.lap[700].accel_mps2 += 0.1; },
                "lap: s = 700.0 m: error: an acceleration of ");
  course.expect([](Raceline& l) { l.lap[700].time_s += 0.01; },
                "lap: s = 700.0 m: error: a time of ");
  course.expect([](Raceline& l) { l.lap_s -= 0.01; }, "lap: error: the lap is said to take ");
  course.expect([](Raceline& l) { l.lap[3].speed_mps = kUnset; }, "lap: s = 3.0 m: error: a speed");
  course.expect([](Raceline& l) { l.lap.pop_back(); }, "lap: error: has no speed profile");
}

TEST(LapCheck, RefusesTheProfileOfWarmTyresOnColdOnes) {
  const Course course;
  envelope::EnvelopeParams cold = envelope::testing::av21_envelope();
  cold.friction = envelope::on_tyres(cold.friction, 30.0);
  EXPECT_FALSE(check_lap(course.line, course.road, envelope::EnvelopeTable{cold}));
}

TEST(LapCheck, RefusesWhatPassesACap) {
  Course course;
  course.road[600].cap_mps = 20.0;
  course.expect([](Raceline&) {}, "lap: s = 600.0 m: error: a speed of ");
}

}  // namespace
}  // namespace pitwall::raceline
