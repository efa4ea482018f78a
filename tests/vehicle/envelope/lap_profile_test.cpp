// SPDX-License-Identifier: Apache-2.0
#include "vehicle/envelope/lap_profile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "tests/support/allocation_guard.hpp"
#include "tests/vehicle/envelope/roads.hpp"

namespace pitwall::envelope {
namespace {

using world::LapPoint;

struct Lap {
  LapOutcome outcome;
  std::vector<LapPoint> points;
};

Lap solved(const EnvelopeParams& car, const std::vector<RoadStep>& road) {
  const EnvelopeTable table{car};
  Lap lap{{}, std::vector<LapPoint>(road.size())};
  lap.outcome = LapProfile{table}.solve(road, lap.points);
  return lap;
}

// From one point of 10 m/s and back to it over 1000 m: with 5 m/s2 to the speed from which 8 m/s2
// lead back; constant accelerations, so that the closed form is exact up to the point in between.
TEST(LapProfile, IsTheClosedFormOfConstantAccelerations) {
  std::vector<RoadStep> road = testing::straight(1000);
  road[0].cap_mps = 10.0;
  const Lap lap = solved(testing::block_envelope(), road);
  // 100 + 2 5 s = 100 + 2 8 (1000 - s)
  const double turn_m = 8000.0 / 13.0, top = std::sqrt(100.0 + 10.0 * turn_m);
  EXPECT_NEAR(lap.outcome.lap_s, (top - 10.0) / 5.0 + (top - 10.0) / 8.0, 1e-3);
  for (const std::size_t i : {1UL, 300UL, 600UL})
    EXPECT_NEAR(lap.points[i].speed_mps, std::sqrt(100.0 + 10.0 * static_cast<double>(i)), 1e-9);
  for (const std::size_t i : {630UL, 800UL, 999UL})
    EXPECT_NEAR(lap.points[i].speed_mps, std::sqrt(100.0 + 16.0 * static_cast<double>(1000 - i)),
                1e-9);
  EXPECT_NEAR(lap.points[300].accel_mps2, 5.0, 1e-9);
  EXPECT_NEAR(lap.points[800].accel_mps2, -8.0, 1e-9);
  EXPECT_NEAR(lap.points[300].time_s, (lap.points[300].speed_mps - 10.0) / 5.0, 1e-9);
}

TEST(LapProfile, ACircleIsDrivenAtTheSpeedOfItsTyres) {
  std::vector<RoadStep> road(600, RoadStep{1.0 / 50.0, 0.0, kNoCap_mps, 1.0});
  const Lap lap = solved(testing::block_envelope(), road);
  const double speed = std::sqrt(2.5 * kGravity_mps2 * 50.0);
  EXPECT_NEAR(lap.outcome.lap_s, 600.0 / speed, 1e-6);
}

// Flat out: where power is what drag takes.
TEST(LapProfile, ALapWithoutCornersHasTheTopSpeed) {
  EnvelopeParams car = testing::block_envelope();
  car.friction.drag_per_m = 0.001, car.friction.power_w_per_kg = 200.0;
  const double top = std::cbrt(200.0 / 0.001);
  const Lap lap = solved(car, testing::straight(2000));
  for (const LapPoint& p : lap.points) EXPECT_NEAR(p.speed_mps, top, 0.02);
}

// The lap is closed: where it begins does not matter.
TEST(LapProfile, DoesNotDependOnItsStart) {
  std::vector<RoadStep> road = testing::lap();
  const Lap first = solved(testing::av21_envelope(), road);
  ASSERT_FALSE(first.outcome.stuck);
  for (const long by : {1L, 450L, 1350L, 2399L}) {
    std::vector<RoadStep> turned = road;
    std::rotate(turned.begin(), turned.begin() + by, turned.end());
    const Lap lap = solved(testing::av21_envelope(), turned);
    EXPECT_NEAR(lap.outcome.lap_s, first.outcome.lap_s, 1e-9);
    for (std::size_t i = 0; i < turned.size(); i += 7) {
      const auto at = (i + static_cast<std::size_t>(by)) % road.size();
      EXPECT_NEAR(lap.points[i].speed_mps, first.points[at].speed_mps, 1e-9);
      EXPECT_EQ(lap.points[i].gear, first.points[at].gear);
    }
  }
}

// Driven the other way round a mirrored lap is the same.
TEST(LapProfile, DoesNotDependOnTheHand) {
  std::vector<RoadStep> road = testing::lap();
  const Lap lap = solved(testing::av21_envelope(), road);
  for (RoadStep& step : road)
    step.curvature_per_m = -step.curvature_per_m, step.bank_rad = -step.bank_rad;
  EXPECT_NEAR(solved(testing::av21_envelope(), road).outcome.lap_s, lap.outcome.lap_s, 1e-9);
}

// A shift of t loses the speed that the drive had given in t, and its own drag.
TEST(LapProfile, ShiftsCutTheDrive) {
  const std::vector<RoadStep> road = testing::lap();
  EnvelopeParams car = testing::av21_envelope();
  car.friction.engine.shift_s = 0.0;
  const Lap quick = solved(car, road);
  car.friction.engine.shift_s = 0.3;
  const Lap slow = solved(car, road);
  int shifts = 0;
  double cut_s = 0.0;
  const EnvelopeTable table{car};
  for (std::size_t i = 0; i < road.size(); ++i) {
    const LapPoint &a = slow.points[i], &b = slow.points[(i + 1) % road.size()];
    if (b.gear > a.gear) shifts += b.gear - a.gear;
    const double drive =
        table.longitudinal(table.place(road[i].curvature_per_m, road[i].bank_rad), a.speed_mps)
            .accel_mps2;
    // The share of a step without drive, where the drive limits.
    const double coasting = table.coasting_mps2(a.speed_mps);
    if (a.accel_mps2 < drive - 1e-9 && a.accel_mps2 > -coasting - 1e-9)
      cut_s += (drive - a.accel_mps2) / (drive + coasting) / a.speed_mps;
  }
  EXPECT_GT(shifts, 6);
  EXPECT_GT(slow.outcome.lap_s, quick.outcome.lap_s + 0.1);
  EXPECT_LT(slow.outcome.lap_s, quick.outcome.lap_s + 0.3 * shifts);
  EXPECT_GT(cut_s, 0.3 * (shifts - 3));  // a corner or a brake may end a cut
}

TEST(LapProfile, TellsWhereNoSpeedCarries) {
  std::vector<RoadStep> road = testing::lap();
  road[1234] = {0.0, from_deg(40.0), kNoCap_mps, 1.0};
  EnvelopeParams car = testing::av21_envelope();
  car.friction.friction = 0.8, car.friction.downforce_per_m = 0.0;  // tan(40 deg) is 0.84
  car.bank_most_rad = from_deg(40.0);
  const Lap lap = solved(car, road);
  ASSERT_TRUE(lap.outcome.stuck);
  EXPECT_EQ(*lap.outcome.stuck, 1234U);
}

TEST(LapProfile, TakesNoMemory) {
  const std::vector<RoadStep> road = testing::lap();
  const EnvelopeTable table{testing::av21_envelope()};
  LapProfile profile{table};
  std::vector<LapPoint> points(road.size());
  profile.solve(road, points);
  double best_ms = 1e9;
  for (int i = 0; i < 5; ++i) {
    const std::clock_t begin = std::clock();
    const auto allocations = pitwall::testing::allocations_of([&] { profile.solve(road, points); });
    best_ms = std::min(best_ms, 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    if (pitwall::testing::kAllocationsCounted) {
      EXPECT_EQ(allocations, 0U);
    }
  }
  std::printf("lap profile: %zu points in %.3f ms, best of 5\n", road.size(), best_ms);
}

}  // namespace
}  // namespace pitwall::envelope
