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

DriveLimits drive_to(double target_mps) {
  return {.target_mps = target_mps,
          .pace = kParams.comfort,
          .corners = kParams.comfort,
          .friction = kParams.line.friction,
          .grip_share = kParams.line.grip_share,
          .tyres = world::kWarmTyres,
          .steering = nullptr};
}

const StopLimits kStop{kParams.line.friction, kParams.stop_grip_share, kParams.stop_decel_max_mps2,
                       kParams.stop_jerk_max_mps3};

TEST(SpeedProfile, DriveStartsAtTheReferenceAndReachesTheTarget) {
  const Line line = line_of();
  const SpeedProfile p =
      drive_profile(look_ahead(line, 0.0, drive_to(40.0)), {30.0, 0.0}, drive_to(40.0), 2.5);
  EXPECT_NEAR(p.at[0].speed_mps, 30.0, 1e-9);
  EXPECT_NEAR(p.at.back().speed_mps, 40.0, 0.05);
  for (std::size_t i = 1; i < p.at.size(); ++i) {
    EXPECT_GE(p.at[i].speed_mps, p.at[i - 1].speed_mps - 5e-3);
    const double accel =
        (std::pow(p.at[i].speed_mps, 2) - std::pow(p.at[i - 1].speed_mps, 2)) / 5.0;
    EXPECT_LE(accel, kParams.comfort.accel_max_mps2 * 1.01);
  }
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
