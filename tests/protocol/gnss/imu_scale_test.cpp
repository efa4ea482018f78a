// SPDX-License-Identifier: Apache-2.0
#include "protocol/gnss/imu_scale.hpp"

#include <gtest/gtest.h>

namespace pitwall::gnss {
namespace {

// The manual's own example of RAWIMUSX is a receiver at rest: one g upwards, hardly any rotation.
TEST(ImuScale, TheManualsExampleAtRestReadsOneG) {
  const ImuScale scale = imu_scale(41).value();
  const double x = 4'508'389 * scale.accel_mps2, y = 2'706'935 * scale.accel_mps2,
               z = 329'308'016 * scale.accel_mps2;
  EXPECT_NEAR(std::hypot(x, y, z), kGravity_mps2, 0.01 * kGravity_mps2);
  EXPECT_LT(std::abs(-1'000'837 * scale.rate_rad_per_s), from_deg(0.2));
}

TEST(ImuScale, AnUnknownTypeHasNone) { EXPECT_FALSE(imu_scale(0).has_value()); }

TEST(ImuScale, CountsRoundToNearestAndSaturate) {
  EXPECT_EQ(to_counts(1.26, 0.5), 3);
  EXPECT_EQ(to_counts(-1.26, 0.5), -3);
  EXPECT_EQ(to_counts(1e30, 1.0), 2'147'483'647);
  EXPECT_EQ(to_counts(-1e30, 1.0), -2'147'483'647);
}

// NovAtel's vehicle frame: x right, y forward, z up; the receiver writes its y negated.
TEST(ImuScale, BodyMotionIsCountedOnTheAxesOfTheEnclosure) {
  RawImuSx m;
  count_body_motion({1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}, m);
  const ImuScale one = imu_scale(m.imu_type).value();
  EXPECT_NEAR(m.x_gyro * one.rate_rad_per_s, -2.0, 1e-8);
  EXPECT_NEAR(m.minus_y_gyro * one.rate_rad_per_s, -1.0, 1e-8);
  EXPECT_NEAR(m.z_gyro * one.rate_rad_per_s, 3.0, 1e-8);
  EXPECT_NEAR(m.x_accel * one.accel_mps2, -5.0, 1e-7);
  EXPECT_NEAR(m.minus_y_accel * one.accel_mps2, -4.0, 1e-7);
  EXPECT_NEAR(m.z_accel * one.accel_mps2, 6.0, 1e-7);
}

}  // namespace
}  // namespace pitwall::gnss
