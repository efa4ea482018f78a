// SPDX-License-Identifier: Apache-2.0
#include "hil/traffic/speed_table.hpp"

#include <gtest/gtest.h>

#include "tests/hil/traffic/oval.hpp"

namespace pitwall::traffic {
namespace {

constexpr double kLength_m = 1'000.0, kBrake_mps2 = 8.0;

TEST(SpeedTable, IsInTimeAtALowerSpeed) {
  // A step from 60 to 30 m/s within 10 m, at the seam of the lap.
  const SpeedTable table({{0.0, 30.0}, {100.0, 30.0}, {300.0, 60.0}, {990.0, 60.0}}, kLength_m,
                         kBrake_mps2);
  EXPECT_NEAR(table.at(50.0), 30.0, 1e-9);
  EXPECT_NEAR(table.at(200.0), 45.0, 1e-3);
  EXPECT_NEAR(table.at(500.0), 60.0, 1e-9);
  for (const double before_m : {1.0, 30.0, 100.0})  // v^2 = 30^2 + 2 a d
    EXPECT_NEAR(table.at(kLength_m - before_m), std::sqrt(900.0 + 2.0 * kBrake_mps2 * before_m),
                1e-9);
  for (double s_m = 0.0; s_m < kLength_m - 1.0; s_m += 0.5) {
    const double here = table.at(s_m), next = table.at(s_m + 0.5);
    EXPECT_LE(0.5 * (here * here - next * next) / 0.5, kBrake_mps2 + 1e-6) << s_m;
  }
}

TEST(SpeedTable, OfOneSpeedIsConstant) {
  EXPECT_DOUBLE_EQ(SpeedTable(37.0).at(123.0), 37.0);
  EXPECT_DOUBLE_EQ(SpeedTable({{40.0, 37.0}}, kLength_m, kBrake_mps2).at(3.0), 37.0);
}

TEST(SpeedTable, OfALapIsItsShare) {
  // Linear between points a metre apart and in the square over 2 m: v''/8 times 4 m^2 is 5e-4 m/s.
  const SpeedTable table(lap_of(bank().lines[0], oval(), 0.8), oval().length_m(), kBrake_mps2);
  for (double s_m = 0.0; s_m < oval().length_m(); s_m += 7.3)
    EXPECT_NEAR(table.at(s_m), 0.8 * swing_mps(s_m), 1e-3) << s_m;
}

}  // namespace
}  // namespace pitwall::traffic
