// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/filter/ekf_3d.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/autonomy/localization/oval.hpp"
#include "vehicle/autonomy/localization/filter/ekf_3d_errors.hpp"
#include "vehicle/autonomy/localization/filter/rotation.hpp"

namespace pitwall::localization {
namespace {

using Eigen::Vector3d;
using testing::Oval;

// At speed in a bank, every error and bias different from zero.
SpatialBelief in_turn() {
  SpatialBelief b;
  b.position_m = {120.0, -80.0, 2.0};
  const Eigen::Quaterniond q = rotation_of({2.0, -0.03, -0.33});
  b.attitude = {q.w(), q.x(), q.y(), q.z()};
  as_vector(b.velocity_mps) = q * Vector3d(66.0, -1.2, 0.1);
  b.gyro_bias_rad_per_s = {0.001, -0.002, 0.0015};
  b.accel_bias_mps2 = {0.03, -0.02, 0.05};
  b.gyro_scale = 0.002, b.accel_scale = -0.001;
  b.wander = {{{0.3, -0.8, 1.1}, {0.2, 0.5, -0.4}}};
  b.now = b.last_imu = {{0.02, -0.1, 0.3}, {1.5, 14.0, 16.0}};
  b.imu_received = true;
  return b;
}

// The error that takes `from` to `to`.
ErrorVector error_between(const SpatialBelief& from, const SpatialBelief& to) {
  ErrorVector e;
  e.segment<3>(kDp) = as_vector(to.position_m) - as_vector(from.position_m);
  e.segment<3>(kPhi) = log_rotation(quaternion_of(to) * quaternion_of(from).conjugate());
  e.segment<3>(kDv) = as_vector(to.velocity_mps) - as_vector(from.velocity_mps);
  e.segment<3>(kDbg) = as_vector(to.gyro_bias_rad_per_s) - as_vector(from.gyro_bias_rad_per_s);
  e.segment<3>(kDba) = as_vector(to.accel_bias_mps2) - as_vector(from.accel_bias_mps2);
  for (std::size_t u = 0; u < 2; ++u)
    e.segment<3>(kDw + 3 * static_cast<Eigen::Index>(u)) =
        as_vector(to.wander[u]) - as_vector(from.wander[u]);
  e[kDs] = to.gyro_scale - from.gyro_scale;
  e[kDa] = to.accel_scale - from.accel_scale;
  return e;
}

TEST(Ekf3d, TransitionIsTheDerivativeOfTheMotion) {
  for (const double dt_s : {0.002, 0.01}) {
    const SpatialBelief b = in_turn();
    const ErrorMatrix f = transition(b, b.now, dt_s, 30.0);
    SpatialBelief after = b;
    integrate(after, b.now, dt_s);
    for (int i = 0; i < kErrors; ++i) {
      if (i >= kDw && i < kDw + 6) continue;  // wanders are no part of integrate()
      constexpr double kStep = 1e-5;
      ErrorVector step = ErrorVector::Zero();
      step[i] = kStep;
      SpatialBelief more = b, less = b;
      inject(more, step), inject(less, -step);
      integrate(more, b.now, dt_s), integrate(less, b.now, dt_s);
      const ErrorVector numeric = error_between(less, more) / (2.0 * kStep);
      EXPECT_LT((numeric - f.col(i)).cwiseAbs().maxCoeff(), 1e-5) << i << " " << dt_s;
    }
    EXPECT_NEAR(f(kDw, kDw), std::exp(-dt_s / 30.0), 1e-15);
  }
}

TEST(Ekf3d, CovarianceFollowsTheTransition) {
  const SpatialParams p = testing::recommended_spatial();
  Random random{1};
  SpatialBelief b = in_turn();
  Eigen::Map<ErrorMatrix> cov(b.covariance.data());
  ErrorMatrix root;
  for (int i = 0; i < kErrors * kErrors; ++i) root.data()[i] = 0.1 * testing::draw_normal(random);
  cov = root * root.transpose();
  constexpr double kStep_s = 0.01;
  const ErrorMatrix f = transition(b, b.last_imu, kStep_s, p.position_wander_s);
  const ErrorMatrix expected = f * cov * f.transpose();
  advance(b, p, Instant{} + from_seconds(kStep_s), nullptr);
  ErrorMatrix noise = cov - expected;
  EXPECT_NEAR(noise(kPhi, kPhi), std::pow(p.gyro_rad_per_sqrt_s, 2) * kStep_s, 1e-12);
  EXPECT_NEAR(noise(kDv, kDv), std::pow(p.accel_mps_per_sqrt_s, 2) * kStep_s, 1e-12);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(noise(kDbg + axis, kDbg + axis),
                std::pow(p.gyro_bias_rad_per_s_sqrt_s, 2) * kStep_s, 1e-14);
    EXPECT_NEAR(noise(kDba + axis, kDba + axis), std::pow(p.accel_bias_mps2_sqrt_s, 2) * kStep_s,
                1e-14);
  }
  const double keep = std::exp(-kStep_s / p.position_wander_s);
  EXPECT_NEAR(noise(kDw, kDw), 1.0 - keep * keep, 1e-12);
  EXPECT_NEAR(noise(kDw, kDw + 3), p.position_wander_together * (1.0 - keep * keep), 1e-12);
  noise.diagonal().setZero();
  for (int i = kDw; i < kDw + 3; ++i) noise(i, i + 3) = noise(i + 3, i) = 0.0;
  EXPECT_LT(noise.cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ((cov - cov.transpose()).cwiseAbs().maxCoeff(), 0.0);
}

// Without noise the IMU alone carries the car round the oval: its place on the car, the turning of
// the attitude and the curve between samples are all taken in.
TEST(Ekf3d, AnHonestImuCarriesTheCarRound) {
  const Oval oval;
  const SpatialParams p = testing::recommended_spatial();
  testing::OvalSensors perfect;
  perfect.gyro_rad_per_s = perfect.accel_mps2 = perfect.gyro_bias_rad_per_s = 0.0;
  perfect.accel_bias_mps2 = perfect.scale = 0.0;
  testing::OvalDrive drive(oval, 1, perfect);
  SpatialBelief b;
  const testing::Pose from = oval.pose(0.0);
  const Eigen::Quaterniond q(from.attitude);
  as_vector(b.position_m) = from.at;
  b.attitude = {q.w(), q.x(), q.y(), q.z()};
  as_vector(b.velocity_mps) = oval.velocity(0.0);
  constexpr double kFor_s = 10.0;
  for (const auto& arrival : drive.run(kFor_s)) {
    if (arrival.measurement.kind != Kind::kImu) continue;
    advance(b, p, arrival.measurement.at, &arrival.measurement);
    apply_imu(b, p, arrival.measurement);
  }
  const double t = (b.at - Instant{}).seconds();
  const testing::Pose to = oval.pose(t);
  EXPECT_GT(t, kFor_s - 0.01);
  EXPECT_LT((as_vector(b.position_m) - to.at).norm(), 0.05);
  EXPECT_LT((as_vector(b.velocity_mps) - oval.velocity(t)).norm(), 0.01);
  EXPECT_LT(log_rotation(Eigen::Quaterniond(to.attitude) * quaternion_of(b).conjugate()).norm(),
            1e-4);
}

// A sample that says only how the car turns, and how it is pushed in the plane.
TEST(Ekf3d, WhatStandsInForAnImuIsFilledFromTheRoad) {
  const Oval level{.half_length_m = 250.0, .half_width_m = 250.0};
  const SpatialParams p = testing::recommended_spatial();
  SpatialBelief b;
  const testing::Pose from = level.pose(0.0);
  const Eigen::Quaterniond q(from.attitude);
  as_vector(b.position_m) = from.at;
  b.attitude = {q.w(), q.x(), q.y(), q.z()};
  as_vector(b.velocity_mps) = level.velocity(0.0);
  for (std::int64_t ms = 0; ms <= 1000; ms += 10) {
    const double t = static_cast<double>(ms) * 1e-3;
    Measurement m{.kind = Kind::kImu, .at = Instant{ms * 1'000'000}};
    m.imu.rate_rad_per_s[2] = level.rate(t).z();
    m.imu.force_mps2 = {level.force(t).x(), level.force(t).y(), kUnset};
    advance(b, p, m.at, &m);
    apply_imu(b, p, m);
    EXPECT_TRUE(b.imu_is_substitute);
    for (const double x : b.last_imu.rate_rad_per_s) EXPECT_TRUE(std::isfinite(x));
    EXPECT_NEAR(b.last_imu.force_mps2[2], level.force(t).z(), 1.5);
  }
  EXPECT_LT((as_vector(b.position_m) - level.pose(1.0).at).norm(), 1.5);
  const Eigen::Map<const ErrorMatrix> cov(b.covariance.data());
  EXPECT_GT(std::sqrt(cov(kPhi + 2, kPhi + 2)), 0.02);  // and it is not trusted
}

TEST(Ekf3d, AnotherImuHasOtherBiases) {
  const SpatialParams p = testing::recommended_spatial();
  SpatialBelief b = in_turn();
  Measurement m{.kind = Kind::kImu, .unit = 1, .imu = {{0.0, 0.0, 0.3}, {0.0, 14.0, 16.0}}};
  apply_imu(b, p, m);
  EXPECT_EQ(b.gyro_bias_rad_per_s[2], 0.0);
  EXPECT_EQ(b.accel_scale, 0.0);
  const Eigen::Map<const ErrorMatrix> cov(b.covariance.data());
  EXPECT_NEAR(std::sqrt(cov(kDbg, kDbg)), p.gyro_bias_start_rad_per_s, 1e-15);
  b.gyro_bias_rad_per_s[2] = 0.001;
  apply_imu(b, p, m);  // the same again
  EXPECT_EQ(b.gyro_bias_rad_per_s[2], 0.001);
}

TEST(Ekf3d, ASilentImuIsNotTrusted) {
  const SpatialParams p = testing::recommended_spatial();
  const auto yaw_sigma_after = [&](Duration gap) {
    SpatialBelief b = in_turn();
    advance(b, p, b.at + gap, nullptr);
    const Eigen::Map<const ErrorMatrix> cov(b.covariance.data());
    return std::sqrt(cov(kPhi + 2, kPhi + 2));
  };
  EXPECT_LT(yaw_sigma_after(milliseconds(40)), 1e-4);
  EXPECT_GT(yaw_sigma_after(milliseconds(200)), 0.01);
  SpatialBelief b = in_turn();
  advance(b, p, b.at + seconds(1'000'000), nullptr);  // bounded in work
  EXPECT_EQ(b.at, Instant{} + seconds(1'000'000));
  EXPECT_GT(b.covariance[0], 1e3);
}

}  // namespace
}  // namespace pitwall::localization
