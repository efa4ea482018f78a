// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/filter/ekf_planar.hpp"

#include <gtest/gtest.h>

#include "tests/vehicle/autonomy/localization/recommended.hpp"

namespace pitwall::localization {
namespace {

const PlanarParams kPlanarParams = testing::recommended_planar();

PlanarBelief at_speed(double vx_mps) {
  PlanarBelief b;
  b.belief.mean = {0.0, 0.0, 0.0, vx_mps, 0.0, 0.0};
  for (std::size_t i = 0; i < kStates; ++i) b.belief.covariance[i * kStates + i] = 0.25;
  return b;
}

Innovation fold(PlanarBelief& b, const Measurement& m) {
  return PlanarModel::fold(b, kPlanarParams, m, nullptr);
}

TEST(EkfPlanar, DrivesByTheImuAndTheBankOfTheRoad) {
  PlanarBelief b = at_speed(50.0);
  EXPECT_TRUE(fold(b, {.kind = Kind::kImu, .imu = {{9.0, 9.0, 0.2}, {1.0, 7.0, 9.0}}}).accepted);
  EXPECT_TRUE(fold(b, {.kind = Kind::kRoad, .road = {.bank_rad = 0.3}}).accepted);
  EXPECT_EQ(b.belief.motion.yaw_rate_rad_per_s, 0.2);
  EXPECT_EQ(b.belief.motion.fx_mps2, 1.0);
  EXPECT_EQ(b.belief.motion.fy_mps2, 7.0);
  EXPECT_EQ(b.belief.motion.bank_rad, 0.3);
  EXPECT_TRUE(fold(b, {.kind = Kind::kImu, .imu = {{0, 0, 0.1}, {0, 0, 9.0}}}).accepted);
  EXPECT_EQ(b.belief.motion.bank_rad, 0.3);  // held
}

TEST(EkfPlanar, GivesEachSensorItsSigma) {
  const auto sigma_after = [](Measurement m, StateIndex index) {
    PlanarBelief b = at_speed(50.0);
    EXPECT_TRUE(fold(b, m).accepted);
    const auto i = static_cast<std::size_t>(index);
    const double left = b.belief.covariance[i * kStates + i];  // 1 / left = 1 / 0.25 + 1 / var
    return std::sqrt(1.0 / (1.0 / left - 4.0));
  };
  Measurement p{.kind = Kind::kPosition, .a = 0, .b = 0, .sigma_a = 0.03, .sigma_b = 0.03};
  EXPECT_NEAR(sigma_after(p, kX), std::hypot(0.03, kPlanarParams.position_sigma_floor_m), 1e-9);
  Measurement v{.kind = Kind::kVelocity, .a = 50, .b = 0, .sigma_a = 9.0};  // its own is not asked
  EXPECT_NEAR(sigma_after(v, kVx), kPlanarParams.velocity_sigma_mps, 1e-3);
  Measurement h{.kind = Kind::kHeading, .a = 0};  // says nothing of its sigma
  EXPECT_NEAR(sigma_after(h, kYaw), kPlanarParams.heading_sigma_floor_rad, 1e-9);
  Measurement w{.kind = Kind::kWheelSpeed, .a = 50};
  EXPECT_NEAR(sigma_after(w, kVx),
              std::hypot(kPlanarParams.wheel_sigma_mps, 50 * kPlanarParams.wheel_sigma_per_speed),
              1e-6);
}

TEST(EkfPlanar, TheTyreModelStandsInForAVelocityThatIsMissing) {
  PlanarBelief b = at_speed(50.0);
  b.belief.motion = {.yaw_rate_rad_per_s = 0.2, .fx_mps2 = 0, .fy_mps2 = 10.0, .bank_rad = 0};
  const double expected = 1.247 * 0.2 - 50.0 * 0.0014 * 10.0;
  PlanarBelief alone = b;
  EXPECT_TRUE(fold(alone, {.kind = Kind::kSlip}).accepted);
  EXPECT_LT(alone.belief.mean[kVy], 0.0);
  EXPECT_GT(alone.belief.mean[kVy], expected);
  PlanarBelief helped = b;
  EXPECT_TRUE(fold(helped, {.kind = Kind::kVelocity, .a = 50, .b = 0}).accepted);
  const auto before = helped.belief.mean;
  EXPECT_FALSE(fold(helped, {.kind = Kind::kSlip}).accepted);
  EXPECT_EQ(helped.belief.mean, before);
  PlanarBelief slow = at_speed(2.0);
  EXPECT_TRUE(fold(slow, {.kind = Kind::kVelocity, .a = 2, .b = 0}).accepted);
  EXPECT_TRUE(fold(slow, {.kind = Kind::kSlip}).accepted);  // nothing slips there
}

TEST(EkfPlanar, KnowsNothingOfAnAttitude) {
  PlanarBelief b = at_speed(50.0);
  const auto before = b.belief.mean;
  EXPECT_FALSE(fold(b, {.kind = Kind::kAttitude, .a = 0.1, .b = 0.1, .c = 0.1}).accepted);
  EXPECT_EQ(b.belief.mean, before);
}

}  // namespace
}  // namespace pitwall::localization
