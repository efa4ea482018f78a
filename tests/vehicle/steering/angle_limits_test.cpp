// SPDX-License-Identifier: Apache-2.0
#include "vehicle/steering/angle_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::steering {
namespace {

constexpr AngleLimits kLimits{{{0.0, 0.21},
                               {15.0, 0.21},
                               {20.0, 0.2},
                               {25.0, 0.18},
                               {30.0, 0.15},
                               {40.0, 0.087},
                               {50.0, 0.059},
                               {60.0, 0.045},
                               {70.0, 0.036},
                               {80.0, 0.03}}};

AngleBudget budget_of(double understeer, double share = 1.0) {
  return {.limits = kLimits,
          .wheelbase_m = 3.0,
          .understeer_rad_per_mps2 = understeer,
          .offset_rad = 0.001,
          .share = share};
}

double needed_rad(const AngleBudget& b, double speed_mps, double curvature_per_m, double bank_rad) {
  const double turn_per_m = std::abs(curvature_per_m) * std::cos(bank_rad);
  const double way = curvature_per_m < 0.0 ? -1.0 : 1.0;
  return b.wheelbase_m * turn_per_m + way * b.offset_rad +
         b.understeer_rad_per_mps2 *
             (speed_mps * speed_mps * turn_per_m - way * kGravity_mps2 * std::sin(bank_rad));
}

TEST(AngleLimits, AreThoseOfTheRowsAndLinearBetween) {
  for (const AngleRow& row : kLimits)
    EXPECT_DOUBLE_EQ(angle_max_rad(kLimits, row.speed_mps), row.angle_rad);
  EXPECT_DOUBLE_EQ(angle_max_rad(kLimits, 45.0), 0.073);
  EXPECT_DOUBLE_EQ(angle_max_rad(kLimits, 200.0), 0.03);
  EXPECT_DOUBLE_EQ(angle_max_rad(kLimits, std::nan("")), 0.03);  // as the gate judges it
}

// The law: at the fastest speed the road needs what is allowed, and any faster one needs more.
TEST(AngleLimits, TheFastestSpeedNeedsWhatIsAllowed) {
  int limited = 0;
  for (const double share : {0.8, 0.9, 1.0})
    for (double understeer = 0.0; understeer < 0.0031; understeer += 0.0005)
      for (double curvature = -0.02; curvature < 0.021; curvature += 0.002)
        for (const double bank : {0.0, 0.16, 0.35}) {
          const AngleBudget b = budget_of(understeer, share);
          const double bank_rad = std::copysign(bank, curvature);
          const double v = fastest_mps(b, curvature, bank_rad);
          ASSERT_LE(v, kLimits.back().speed_mps);
          const auto spare = [&](double speed_mps) {
            return share * angle_max_rad(kLimits, speed_mps) -
                   needed_rad(b, speed_mps, curvature, bank_rad);
          };
          EXPECT_GE(spare(v), -1e-9) << understeer << " " << curvature << " " << bank;
          if (v >= kLimits.back().speed_mps) continue;
          ++limited;
          EXPECT_LT(spare(v + 0.01), 0.0) << understeer << " " << curvature << " " << bank;
        }
  EXPECT_GT(limited, 100);
}

TEST(AngleLimits, ARoadThatNoSpeedCanFollowHasNone) {
  EXPECT_EQ(fastest_mps(budget_of(0.0), 0.2, 0.0), 0.0);
}

}  // namespace
}  // namespace pitwall::steering
