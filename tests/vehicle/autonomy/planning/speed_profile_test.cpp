// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/speed_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/autonomy/planning/stadium.hpp"
#include "vehicle/autonomy/planning/stop_plan.hpp"

namespace pitwall::planning {
namespace {

using testing::kParams;

Line line_of(double radius_m = 200.0) {
  auto line = build_line(testing::stadium(radius_m), kParams.line);
  EXPECT_TRUE(line);
  return *std::move(line);
}

DriveLimits drive_to(double target) {
  return {target,
          world::kWarmTyres,
          kParams.accel_max_mps2,
          kParams.decel_max_mps2,
          kParams.jerk_max_mps3,
          nullptr};
}

const StopLimits kStop{kParams.line.friction, kParams.stop_grip_share, kParams.stop_decel_max_mps2,
                       kParams.stop_jerk_max_mps3};

TEST(SpeedProfile, ReferenceLandsOnItsTargetWithinItsLimits) {
  for (const double dt : {0.01, 0.02, 0.05}) {
    for (const double from : {0.0, 20.0, 60.0}) {
      for (const double to : {0.0, 0.5, 20.0, 25.0, 60.0}) {
        SpeedReference r{from, 0.0};
        const SpeedLimits limits{to, 2.5, 3.0, 5.0};
        const double low = std::min(from, to), high = std::max(from, to);
        for (int i = 0; i < static_cast<int>(40.0 / dt); ++i) {
          const SpeedReference next = advance(r, limits, dt);
          EXPECT_LE(next.accel_mps2, 2.5 + 1e-9);
          EXPECT_GE(next.accel_mps2, -3.0 - 1e-9);
          if (next.speed_mps > 0.0) {
            EXPECT_LE(std::abs(next.accel_mps2 - r.accel_mps2), 5.0 * dt + 1e-9);
          }
          EXPECT_GE(next.speed_mps, std::max(low - 0.05, 0.0)) << from << ' ' << to << ' ' << dt;
          EXPECT_LE(next.speed_mps, high + 0.05) << from << ' ' << to << ' ' << dt;
          r = next;
        }
        EXPECT_NEAR(r.speed_mps, to, 1e-3) << from << ' ' << to << ' ' << dt;
        EXPECT_NEAR(r.accel_mps2, 0.0, 1e-2);
      }
    }
  }
}

TEST(SpeedProfile, ChangingTargetsNeverStepTheAcceleration) {
  SpeedReference r{30.0, 0.0};
  for (int i = 0; i < 3000; ++i) {
    const double target = (i / 37) % 2 == 0 ? 60.0 : 5.0;
    const SpeedReference next = advance(r, {target, 2.5, 3.0, 5.0}, 0.02);
    EXPECT_LE(std::abs(next.accel_mps2 - r.accel_mps2), 5.0 * 0.02 + 1e-9);
    EXPECT_LE(std::abs(next.speed_mps - r.speed_mps), 3.0 * 0.02 + 1e-9);
    r = next;
  }
}

TEST(SpeedProfile, DriveStartsAtTheReferenceAndReachesTheTarget) {
  const Line line = line_of();
  const SpeedProfile p = drive_profile(line, 0.0, {30.0, 0.0}, drive_to(40.0), 2.5);
  EXPECT_NEAR(p.at[0].speed_mps, 30.0, 1e-9);
  EXPECT_NEAR(p.at.back().speed_mps, 40.0, 0.05);
  for (std::size_t i = 1; i < p.at.size(); ++i) {
    EXPECT_GE(p.at[i].speed_mps, p.at[i - 1].speed_mps - 5e-3);
    const double accel =
        (std::pow(p.at[i].speed_mps, 2) - std::pow(p.at[i - 1].speed_mps, 2)) / 5.0;
    EXPECT_LE(accel, kParams.accel_max_mps2 * 1.01);
  }
}

TEST(SpeedProfile, DriveSlowsInTimeForATightTurn) {
  const Line line = line_of(60.0);
  SpeedReference r{45.0, 0.0};
  double s = 0.0;
  for (int i = 0; i < 4000; ++i) {  // two laps, time step by time step
    const SpeedReference next = advance_drive(line, s, r, drive_to(68.0), 0.02);
    s += 0.5 * (r.speed_mps + next.speed_mps) * 0.02;
    r = next;
    if (i > 500) {
      EXPECT_LE(r.speed_mps, line.at(s).speed_mps.back() + 0.3) << s;
    }
  }
  EXPECT_GT(s, 2.0 * line.length_m);
}

// What lies ahead on the line itself.
RoadAhead ahead(const Line& line, double s_m) { return road_ahead(line, StopPath{}, s_m); }

TEST(SpeedProfile, StopStandsWithinTheEllipseFromEveryPlaceAndSpeed) {
  const Line line = line_of();
  const auto& car = kParams.line.friction;
  for (double s = 0.0; s < line.length_m; s += line.length_m / 16.0) {
    for (const double v : {0.0, 0.5, 8.0, 30.0, 50.0, 65.0}) {
      const SpeedProfile p = stop_profile(ahead(line, s), {v, 0.0}, kStop, 40.0);
      ASSERT_TRUE(std::isfinite(p.stop_distance_m)) << s << ' ' << v;
      EXPECT_LT(p.stop_distance_m, v * v / (2.0 * 2.0) + 3.0 * v + 1.0) << s << ' ' << v;
      EXPECT_EQ(p.at.back().speed_mps, 0.0);
      const double reach_m = p.spacing_m * static_cast<double>(p.at.size() - 1);
      EXPECT_GE(reach_m, p.stop_distance_m + 39.9);
      SpeedReference last{v, 0.0};
      for (std::size_t i = 0; i < p.at.size(); ++i) {
        EXPECT_LE(p.at[i].speed_mps, last.speed_mps + 1e-9);
        last = p.at[i];
        const LinePoint at = line.at(s + static_cast<double>(i) * p.spacing_m);
        const steering::RoadLoad load{last.speed_mps, at.curvature_per_m, at.bank_rad};
        const double tyres =
            -last.accel_mps2 - car.drag_per_m * last.speed_mps * last.speed_mps - 0.3;
        const double used =
            std::hypot(std::max(tyres, 0.0), lateral_demand_mps2(load)) / grip_mps2(car, load);
        EXPECT_LE(used, kParams.stop_grip_share + 0.02) << s << ' ' << v << ' ' << i;
      }
    }
  }
}

TEST(SpeedProfile, StopStartsWithLimitedJerk) {
  const Line line = line_of();
  SpeedReference r{65.0, 1.5};  // from full acceleration
  for (int i = 0; i < 1500; ++i) {
    const SpeedReference next = advance_stop(ahead(line, 500.0), r, kStop, 0.02);
    if (next.speed_mps > 0.0) {
      EXPECT_LE(std::abs(next.accel_mps2 - r.accel_mps2), kParams.stop_jerk_max_mps3 * 0.02 + 1e-9);
    }
    r = next;
  }
  EXPECT_EQ(r.speed_mps, 0.0);
}

}  // namespace
}  // namespace pitwall::planning
