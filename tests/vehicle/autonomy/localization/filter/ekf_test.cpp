// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/filter/ekf.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/eigenvalues.hpp"
#include "tests/vehicle/autonomy/localization/drive.hpp"
#include "vehicle/autonomy/localization/filter/ekf_model.hpp"

namespace pitwall::localization {
namespace {

const MotionNoise kNoise = testing::recommended().filter.planar.noise;
constexpr std::array<double, 2> kOpenGate{1e12, 1e12};

std::vector<Vector6> states_over_the_envelope() {
  std::vector<Vector6> states;
  for (const double yaw : {-3.0, -1.0, 0.3, 2.5})
    for (const double vx : {0.0, 12.0, 70.0})
      for (const double vy : {-2.0, 0.5}) {
        Vector6 x;
        x << 100.0, -50.0, yaw, vx, vy, 0.01;
        states.push_back(x);
      }
  return states;
}

std::vector<Motion> motions() {
  return {{0.0, 0.0, 0.0, 0.0}, {0.35, 2.0, 12.0, from_deg(20.0)}, {-0.2, -5.0, -3.0, -0.1}};
}

template <class Function>
Eigen::MatrixXd numeric_jacobian(const Vector6& x, Eigen::Index rows, Function f) {
  Eigen::MatrixXd j(rows, kStates);
  constexpr double kStep = 1e-5;
  for (int i = 0; i < kStates; ++i) {
    Vector6 up = x, down = x;
    up[i] += kStep, down[i] -= kStep;
    j.col(i) = (f(up) - f(down)) / (2.0 * kStep);
  }
  return j;
}

TEST(Ekf, MotionJacobianMatchesFiniteDifferences) {
  for (const Vector6& x : states_over_the_envelope())
    for (const Motion& m : motions()) {
      const auto numeric =
          numeric_jacobian(x, kStates, [&](const Vector6& y) { return motion_rate(y, m); });
      EXPECT_TRUE((numeric - motion_jacobian(x, m)).isZero(1e-6)) << x.transpose();
    }
}

TEST(Ekf, MeasurementJacobiansMatchFiniteDifferences) {
  for (const Kind kind :
       {Kind::kPosition, Kind::kVelocity, Kind::kHeading, Kind::kWheelSpeed, Kind::kSlip}) {
    Measurement m;
    m.kind = kind;
    m.arm = {1.3, -0.5, 0.7};
    for (const Vector6& x : states_over_the_envelope())
      for (const Motion& motion : motions()) {
        const Predicted p = predict_measurement(x, m, motion);
        ASSERT_GT(p.size, 0);
        const auto numeric = numeric_jacobian(x, p.size, [&](const Vector6& y) {
          return Eigen::VectorXd(predict_measurement(y, m, motion).value.head(p.size));
        });
        EXPECT_TRUE((numeric - p.jacobian.topRows(p.size)).isZero(1e-6))
            << static_cast<int>(kind) << ": " << x.transpose();
      }
  }
}

TEST(Ekf, PredictionFollowsTheClosedFormOfACircle) {
  for (testing::Course course : {testing::banked_turn(), testing::Course{}}) {
    course.slip_rad = 0.0;  // the nose that it lifts or lowers in a bank is not in the planar law
    const world::EgoState from = course.at(0.0), to = course.at(2.0);
    Belief b;
    b.mean = {from.x_m, from.y_m, from.yaw_rad, from.vx_mps, from.vy_mps, 0.0};
    b.motion = {from.yaw_rate_rad_per_s, from.ax_mps2, from.ay_mps2, course.bank_rad};
    advance(b, kNoise, Instant{} + seconds(1));
    advance(b, kNoise, Instant{} + seconds(2));
    EXPECT_NEAR(b.mean[kX], to.x_m, 0.02);
    EXPECT_NEAR(b.mean[kY], to.y_m, 0.02);
    EXPECT_NEAR(wrap_pi(b.mean[kYaw] - to.yaw_rad), 0.0, 1e-6);
    EXPECT_NEAR(b.mean[kVx], to.vx_mps, 1e-3);
    EXPECT_NEAR(b.mean[kVy], to.vy_mps, 1e-3);
  }
}

TEST(Ekf, CovarianceStaysSymmetricAndPositive) {
  Random random{1};
  Belief b;
  b.mean = {0.0, 0.0, 3.1, 40.0, 0.0, 0.0};
  for (int i = 0; i < kStates; ++i) b.covariance[static_cast<std::size_t>(i * kStates + i)] = 1.0;
  b.motion = {0.2, 1.0, 8.0, 0.3};
  for (int i = 0; i < 2000; ++i) {
    advance(b, kNoise, b.at + milliseconds(10));
    Measurement m;
    m.kind = static_cast<Kind>(static_cast<int>(Kind::kPosition) + i % 5);
    m.sigma_a = m.sigma_b = 1e-3 + random.uniform();
    m.arm = {1.0, 0.5, 0.6};
    const Vector6 x = Eigen::Map<const Vector6>(b.mean.data());
    const Predicted p = predict_measurement(x, m, b.motion);
    m.a = p.value[0] + 0.01 * testing::draw_normal(random),
    m.b = p.value[1] + 0.01 * testing::draw_normal(random);
    EXPECT_TRUE(update(b, m, kOpenGate).accepted);
    const Matrix6 c = Eigen::Map<const Matrix6>(b.covariance.data());
    ASSERT_TRUE((c - c.transpose()).isZero(0.0));
    ASSERT_GT(pitwall::testing::smallest_eigenvalue(pitwall::testing::numbers_of(c)), 0.0) << i;
  }
}

TEST(Ekf, GateRefusesAndLeavesTheBeliefAlone) {
  Belief b;
  b.mean = {10.0, 20.0, 0.0, 30.0, 0.0, 0.0};
  for (int i = 0; i < kStates; ++i) b.covariance[static_cast<std::size_t>(i * kStates + i)] = 0.01;
  Measurement m;
  m.kind = Kind::kPosition;
  m.sigma_a = m.sigma_b = 0.1;
  const std::array<double, 2> gate{12.0, 16.0};
  for (const double off : {0.55, 0.57, 5.0, kUnset}) {  // 4 sigma is sqrt(16 * 0.02) = 0.566 m
    Belief after = b;
    m.a = 10.0 + off, m.b = 20.0;
    const Innovation i = update(after, m, gate);
    EXPECT_EQ(i.accepted, off < 0.566) << off;
    EXPECT_EQ(after.mean == b.mean, !i.accepted);
    EXPECT_EQ(after.covariance == b.covariance, !i.accepted);
  }
}

TEST(Ekf, HeadingInnovationTakesTheShortWayRound) {
  Belief b;
  b.mean = {0.0, 0.0, 3.13, 30.0, 0.0, 0.0};
  b.covariance[kYaw * kStates + kYaw] = 0.01;
  Measurement m;
  m.kind = Kind::kHeading;
  m.a = -3.13, m.sigma_a = 0.1;
  EXPECT_TRUE(update(b, m, {12.0, 16.0}).accepted);
  EXPECT_GT(std::abs(b.mean[kYaw]), 3.13);
}

TEST(Ekf, LongGapsAreBoundedInWork) {
  Belief b;
  b.mean = {0.0, 0.0, 0.0, 30.0, 0.0, 0.0};
  advance(b, kNoise, Instant{} + seconds(1'000'000));
  EXPECT_EQ(b.at, Instant{} + seconds(1'000'000));
  EXPECT_GT(b.covariance[0], 1e3);
}

}  // namespace
}  // namespace pitwall::localization
