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

// A car of which something is known: with its understeer sure, or not.
struct SomeCar {
  Bicycle car{.wheelbase_m = 3.0, .understeer_rad_per_mps2 = 0.0};
  LearningParams learning;
  Learned learned;
  double share = 1.0, stray = 8.0;

  explicit SomeCar(double understeer, double deviation = 0.0) {
    learned.offset_rad = 0.001;
    learned.understeer_rad_per_mps2 = understeer;
    learned.covariance = {};
    constexpr std::size_t kOfUndersteer = 4;
    learned.covariance[kOfUndersteer] = deviation * deviation;
  }
  AngleBudget budget() const { return {kLimits, car, learning, learned, share, stray}; }
};

struct Asked {
  double angle_rad, doubt_rad;
};

Asked asked(const SomeCar& some, double speed_mps, double curvature_per_m, double bank_rad) {
  const double turn_per_m = std::abs(curvature_per_m) * std::cos(bank_rad);
  const double way = curvature_per_m < 0.0 ? -1.0 : 1.0;
  const double lateral =
      speed_mps * speed_mps * turn_per_m - way * kGravity_mps2 * std::sin(bank_rad);
  const double doubt = 2.0 * std::sqrt(some.learned.covariance[4]) * std::abs(lateral);
  return {3.0 * turn_per_m + way * 0.001 + some.learned.understeer_rad_per_mps2 * lateral + doubt,
          lateral > 0.0 ? doubt : 0.0};
}

TEST(AngleLimits, AreThoseOfTheRowsAndLinearBetween) {
  for (const AngleRow& row : kLimits)
    EXPECT_DOUBLE_EQ(angle_max_rad(kLimits, row.speed_mps), row.angle_rad);
  EXPECT_DOUBLE_EQ(angle_max_rad(kLimits, 45.0), 0.073);
  EXPECT_DOUBLE_EQ(angle_max_rad(kLimits, 200.0), 0.03);
  EXPECT_DOUBLE_EQ(angle_max_rad(kLimits, std::nan("")), 0.03);  // as the gate judges it
}

// The law: at the fastest speed the road needs what is allowed, and any faster one needs more, or
// strays further by what is not known.
TEST(AngleLimits, TheFastestSpeedNeedsWhatIsAllowed) {
  int limited = 0, doubtful = 0;
  const double most_mps = 80.0;
  for (const double share : {0.8, 1.0})
    for (double understeer = 0.0; understeer < 0.0031; understeer += 0.0005)
      for (const double deviation : {0.0, 0.0001, 0.001})
        for (double curvature = -0.02; curvature < 0.021; curvature += 0.002)
          for (const double bank : {0.0, 0.16, 0.35}) {
            SomeCar some(understeer, deviation);
            some.share = share;
            const double bank_rad = std::copysign(bank, curvature);
            const double v = fastest_mps(some.budget(), curvature, bank_rad, most_mps);
            ASSERT_LE(v, most_mps);
            const auto fits = [&](double speed_mps) {
              const Asked a = asked(some, speed_mps, curvature, bank_rad);
              return a.angle_rad <= share * angle_max_rad(kLimits, speed_mps) + 1e-9 &&
                     a.doubt_rad * speed_mps * speed_mps <= some.stray + 1e-6;
            };
            EXPECT_TRUE(fits(v)) << understeer << " " << curvature << " " << bank;
            if (v >= most_mps) continue;
            ++limited;
            doubtful += asked(some, v, curvature, bank_rad).doubt_rad * v * v > 0.99 * some.stray;
            EXPECT_FALSE(fits(v + 0.02)) << understeer << " " << curvature << " " << bank;
          }
  EXPECT_GT(limited, 100);
  EXPECT_GT(doubtful, 100);
}

TEST(AngleLimits, IsNeverFasterThanWhatIsAskedFor) {
  EXPECT_EQ(fastest_mps(SomeCar(0.0).budget(), 0.001, 0.0, 31.5), 31.5);
}

TEST(AngleLimits, ARoadThatNoSpeedCanFollowHasNone) {
  EXPECT_EQ(fastest_mps(SomeCar(0.0).budget(), 0.2, 0.0, 80.0), 0.0);
}

}  // namespace
}  // namespace pitwall::steering
