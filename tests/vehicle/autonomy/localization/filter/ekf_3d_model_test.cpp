// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/filter/ekf_3d_model.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "tests/vehicle/autonomy/localization/oval.hpp"
#include "vehicle/autonomy/localization/filter/rotation.hpp"

namespace pitwall::localization {
namespace {

using Eigen::Vector3d;

std::vector<SpatialBelief> beliefs() {
  std::vector<SpatialBelief> all;
  for (const Angles& a : {Angles{0.3, -0.02, -0.35}, Angles{-3.0, 0.05, 0.1}, Angles{1.6, 0, 0}}) {
    for (const double speed : {1.0, 30.0, 68.0}) {
      SpatialBelief b;
      const Eigen::Quaterniond q = rotation_of(a);
      b.position_m = {10.0, -20.0, 1.0};
      b.attitude = {q.w(), q.x(), q.y(), q.z()};
      as_vector(b.velocity_mps) = q * Vector3d(speed, -0.02 * speed, 0.01);
      b.gyro_bias_rad_per_s = {0.001, -0.002, 0.003};
      b.accel_bias_mps2 = {0.03, 0.02, -0.04};
      b.gyro_scale = 0.002, b.accel_scale = -0.003;
      b.wander = {{{0.4, -0.6, 1.0}, {-0.2, 0.1, 0.7}}};
      b.now = {{0.02, -0.08, 0.005 * speed}, {1.0, 0.3 * speed, 14.0}};
      all.push_back(b);
    }
  }
  return all;
}

using Model = std::function<Observation(const SpatialBelief&)>;

Measurement of(Kind kind, std::uint8_t unit, double a, double b, double c) {
  return {.kind = kind,
          .unit = unit,
          .a = a,
          .b = b,
          .c = c,
          .sigma_a = 0.010,
          .sigma_b = 0.012,
          .sigma_c = 0.02,
          .arm = {1.3, -0.5, 0.7},
          .direction_rad = 0.5 * std::numbers::pi};
}

std::vector<Model> models() {
  static const Road road{.x_m = 9.0,
                         .y_m = -21.0,
                         .height_m = 0.5,
                         .bank_rad = 0.3,
                         .climb_rad = -0.02,
                         .direction_rad = 0.4};
  using B = SpatialBelief;
  return {
      [](const B& b) {
        return antenna_position(b, testing::kSpatialParams, of(Kind::kPosition, 0, 9, -19, 2));
      },
      [](const B& b) {
        return antenna_position(b, testing::kSpatialParams, of(Kind::kPosition, 1, 9, -19, kUnset));
      },
      [](const B& b) {
        return antenna_velocity(b, testing::kSpatialParams, of(Kind::kVelocity, 1, 30, 40, 1));
      },
      [](const B& b) {
        return baseline_heading(b, testing::kSpatialParams, of(Kind::kHeading, 1, 1.0, 0, 0));
      },
      [](const B& b) {
        return wheel_speed(b, testing::kSpatialParams, of(Kind::kWheelSpeed, 0, 60, 0, 0));
      },
      [](const B& b) { return rear_slip(b, testing::kSpatialParams); },
      [](const B& b) { return road_tilt(b, testing::kSpatialParams, road); },
      [](const B& b) { return road_height(b, testing::kSpatialParams, road); },
      [](const B& b) { return road_normal(b, testing::kSpatialParams, road); },
  };
}

TEST(Ekf3dModel, JacobiansAreTheDerivatives) {
  std::size_t which = 0;
  for (const Model& model : models()) {
    for (const SpatialBelief& b : beliefs()) {
      const Observation o = model(b);
      ASSERT_GE(o.size, 1);
      for (int i = 0; i < kErrors; ++i) {
        constexpr double kStep = 1e-6;
        ErrorVector step = ErrorVector::Zero();
        step[i] = kStep;
        SpatialBelief more = b, less = b;
        inject(more, step), inject(less, -step);
        const Vector3d numeric = -(model(more).residual - model(less).residual) / (2.0 * kStep);
        for (int r = 0; r < o.size; ++r)
          EXPECT_NEAR(numeric[r], o.jacobian(r, i), 2e-6 * std::max(1.0, std::abs(numeric[r])))
              << "model " << which << " row " << r << " error " << i;
      }
    }
    ++which;
  }
}

// A receiver's attitude differs by the very rotation that is the error of the state.
TEST(Ekf3dModel, AReceiversAttitudeShowsTheErrorItself) {
  for (const SpatialBelief& b : beliefs()) {
    ErrorVector error = ErrorVector::Zero();
    error.segment<3>(kPhi) = Vector3d(1e-4, -2e-4, 3e-4);
    SpatialBelief truth = b;
    inject(truth, error);
    const Angles a = angles_of(quaternion_of(truth).toRotationMatrix());
    Measurement m = of(Kind::kAttitude, 0, a.roll_rad, a.pitch_rad, a.yaw_rad);
    const Observation o = receiver_attitude(b, testing::kSpatialParams, m);
    EXPECT_LT((o.residual - o.jacobian * error).norm(), 1e-7);
    m.c = kUnset;
    EXPECT_EQ(receiver_attitude(b, testing::kSpatialParams, m).size, 2);
  }
}

// On the oval every model sees nothing wrong in the truth, whatever its noise.
TEST(Ekf3dModel, TheTruthLeavesNoResidual) {
  const testing::Oval oval;
  for (const double t : {1.0, 4.0, 9.0, 17.0}) {
    const testing::Pose pose = oval.pose(t);
    SpatialBelief b;
    const Eigen::Quaterniond q(pose.attitude);
    as_vector(b.position_m) = pose.at;
    b.attitude = {q.w(), q.x(), q.y(), q.z()};
    as_vector(b.velocity_mps) = oval.velocity(t);
    as_vector(b.now.rate_rad_per_s) = oval.rate(t);
    as_vector(b.now.force_mps2) = oval.force(t);
    const Road road = oval.road(t);
    EXPECT_LT((normal_of(road) - testing::Oval::up(road)).norm(), 1e-12);
    EXPECT_LT(road_tilt(b, testing::kSpatialParams, road).residual.norm(), 1e-9);
    EXPECT_LT(road_height(b, testing::kSpatialParams, road).residual.norm(), 1e-9);
    EXPECT_LT(road_normal(b, testing::kSpatialParams, road).residual.norm(), 1e-6);
    const Vector3d arm(1.3, -0.5, 0.7);
    constexpr double kStep_s = 5e-4;
    const auto antenna = [&](double at) -> Vector3d {
      return oval.pose(at).at + oval.pose(at).attitude * arm;
    };
    const Vector3d v = (antenna(t + kStep_s) - antenna(t - kStep_s)) / (2.0 * kStep_s);
    EXPECT_LT(
        antenna_velocity(b, testing::kSpatialParams, of(Kind::kVelocity, 0, v.x(), v.y(), v.z()))
            .residual.norm(),
        1e-4);
    EXPECT_LT(
        wheel_speed(b, testing::kSpatialParams, of(Kind::kWheelSpeed, 0, oval.forward_mps(t), 0, 0))
            .residual.norm(),
        1e-9);
  }
}

TEST(Ekf3dModel, TyresSlipByTheirForceButNotAtWalkingPace) {
  SpatialBelief b;
  b.velocity_mps = {60.0, 0.0, 0.0};
  b.now = {{0.0, 0.0, 0.3}, {0.0, 18.0, 9.8}};
  EXPECT_NEAR(rear_slip(b, testing::kSpatialParams).residual[0], 1.247 * 0.3 - 60.0 * 0.0014 * 18.0,
              1e-12);
  b.velocity_mps = {4.0, 0.0, 0.0};
  EXPECT_NEAR(rear_slip(b, testing::kSpatialParams).residual[0], 1.247 * 0.3, 1e-12);
}

TEST(Ekf3dModel, SigmasAreTheReceiversWhereItSaysThem) {
  const SpatialBelief b;
  Measurement m = of(Kind::kVelocity, 0, 0, 0, 0);
  EXPECT_NEAR(antenna_velocity(b, testing::kSpatialParams, m).variance[0], 1e-4, 1e-15);
  m.sigma_a = m.sigma_b = m.sigma_c = kUnset;
  EXPECT_NEAR(antenna_velocity(b, testing::kSpatialParams, m).variance[0],
              std::pow(testing::kSpatialParams.velocity_sigma_mps, 2), 1e-15);
  EXPECT_NEAR(antenna_velocity(b, testing::kSpatialParams, m).variance[2],
              std::pow(testing::kSpatialParams.vertical_velocity_sigma_mps, 2), 1e-15);
  // White and wandering part together are what the receiver says, and the floor.
  const Observation o =
      antenna_position(b, testing::kSpatialParams, of(Kind::kPosition, 1, 0, 0, 0));
  const double wandering = std::pow(o.jacobian(0, kDw + 3), 2);
  EXPECT_NEAR(o.variance[0] + wandering,
              1e-4 + std::pow(testing::kSpatialParams.position_sigma_floor_m, 2), 1e-12);
  EXPECT_EQ(o.jacobian(0, kDw), 0.0);  // of the other receiver
}

}  // namespace
}  // namespace pitwall::localization
