// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/unit_params.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::sensors {
namespace {

// The published places, from the rear axle.
TEST(UnitParams, BaselinesAreThoseOfThePublishedAntennas) {
  EXPECT_NEAR(av21_units()[0].baseline_m, 3.175 - 1.242, 1e-9);
  EXPECT_NEAR(av21_units()[1].baseline_m, 2.0 * 0.497, 1e-9);
  EXPECT_NEAR(av21_units()[1].antenna.x_m - av21_units()[0].antenna.x_m, 2.005 - 1.242, 1e-9);
}

TEST(UnitParams, TheVn310HasTheBetterInertialUnit) {
  const ImuNoise novatel = pwrpak7d_e1().imu, vectornav = vn310().imu;
  EXPECT_LT(vectornav.gyro_rad_per_sqrt_s, novatel.gyro_rad_per_sqrt_s);
  EXPECT_LT(vectornav.gyro_instability_rad_per_s, novatel.gyro_instability_rad_per_s);
  EXPECT_LT(vectornav.accel_mps_per_sqrt_s, novatel.accel_mps_per_sqrt_s);
  EXPECT_GT(vectornav.gyro_range_rad_per_s, novatel.gyro_range_rad_per_s);
}

}  // namespace
}  // namespace pitwall::sensors
