// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/speed_reference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pitwall::planning {
namespace {

TEST(SpeedReference, LandsOnItsTargetWithinItsLimits) {
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

TEST(SpeedReference, ChangingTargetsNeverStepTheAcceleration) {
  SpeedReference r{30.0, 0.0};
  for (int i = 0; i < 3000; ++i) {
    const double target = (i / 37) % 2 == 0 ? 60.0 : 5.0;
    const SpeedReference next = advance(r, {target, 2.5, 3.0, 5.0}, 0.02);
    EXPECT_LE(std::abs(next.accel_mps2 - r.accel_mps2), 5.0 * 0.02 + 1e-9);
    EXPECT_LE(std::abs(next.speed_mps - r.speed_mps), 3.0 * 0.02 + 1e-9);
    r = next;
  }
}

// A target that moves with an acceleration is reached and then followed with it.
TEST(SpeedReference, FollowsATargetThatMoves) {
  for (const double target_mps2 : {-2.0, 0.0, 1.5})
    for (const double from_mps : {30.0, 38.0, 44.0}) {
      constexpr double kStep_s = 0.02;
      SpeedReference r{from_mps, 0.0};
      SpeedLimits limits{.target_mps = 40.0,
                         .accel_max_mps2 = 4.0,
                         .decel_max_mps2 = 6.0,
                         .jerk_max_mps3 = 5.0,
                         .target_accel_mps2 = target_mps2};
      double least_mps = 1e9;
      for (int i = 0; i < 500; ++i) {
        r = advance(r, limits, kStep_s);
        limits.target_mps += target_mps2 * kStep_s;
        least_mps = std::min(least_mps, limits.target_mps - r.speed_mps);
      }
      EXPECT_NEAR(r.speed_mps, limits.target_mps, 0.05) << target_mps2 << ' ' << from_mps;
      EXPECT_NEAR(r.accel_mps2, target_mps2, 0.05);
      // From below it lands without passing the target. A target that slows is met at rest against
      // it: what the jerk takes to begin with is (a / j) a / 2 at most.
      const double begin_mps = 0.5 * target_mps2 * target_mps2 / limits.jerk_max_mps3;
      if (from_mps < 40.0) {
        EXPECT_GE(least_mps, -0.05) << target_mps2 << ' ' << from_mps;
      } else {
        EXPECT_GE(least_mps, 40.0 - from_mps - begin_mps - 0.05);
      }
    }
}

}  // namespace
}  // namespace pitwall::planning
