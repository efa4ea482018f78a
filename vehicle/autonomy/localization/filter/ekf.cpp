// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/filter/ekf.hpp"

#include <Eigen/LU>
#include <cmath>

#include "protocol/vocabulary/check.hpp"
#include "vehicle/autonomy/localization/filter/ekf_model.hpp"
#include "vehicle/autonomy/localization/filter/measurement.hpp"

namespace pitwall::localization {
namespace {

using MeanMap = Eigen::Map<Vector6>;
using CovarianceMap = Eigen::Map<Matrix6>;

void predict(Belief& belief, const MotionNoise& noise, double dt_s) {
  MeanMap x(belief.mean.data());
  CovarianceMap p(belief.covariance.data());
  const Motion& motion = belief.motion;
  // Midpoint rule for the mean, second order for its Jacobian.
  const Vector6 middle = x + 0.5 * dt_s * motion_rate(x, motion);
  const Matrix6 a = motion_jacobian(middle, motion) * dt_s;
  const Matrix6 f = Matrix6::Identity() + a + 0.5 * a * a;
  x += dt_s * motion_rate(middle, motion);
  x[kYaw] = wrap_pi(x[kYaw]);
  const auto density = [dt_s](double sigma) { return sigma * sigma * dt_s; };
  Vector6 q;
  q << density(noise.position_m_per_sqrt_s), density(noise.position_m_per_sqrt_s),
      density(noise.gyro_rad_per_sqrt_s / std::cos(motion.bank_rad)),
      density(noise.accel_mps_per_sqrt_s) + density(noise.gyro_rad_per_sqrt_s * x[kVy]),
      density(noise.lateral_mps_per_sqrt_s) + density(noise.gyro_rad_per_sqrt_s * x[kVx]),
      density(noise.gyro_bias_rad_per_s_sqrt_s);
  const Matrix6 next = f * p * f.transpose();
  p = 0.5 * (next + next.transpose());
  p.diagonal() += q;
}

template <int N>
Innovation apply(Belief& belief, const Measurement& m, const Predicted& predicted,
                 double gate_nis) {
  using VectorN = Eigen::Matrix<double, N, 1>;
  using MatrixN = Eigen::Matrix<double, N, N>;
  MeanMap x(belief.mean.data());
  CovarianceMap p(belief.covariance.data());
  VectorN residual, variance;
  residual[0] = m.a - predicted.value[0];
  variance[0] = m.sigma_a * m.sigma_a;
  if constexpr (N == 2) {
    residual[1] = m.b - predicted.value[1];
    variance[1] = m.sigma_b * m.sigma_b;
  }
  if (m.kind == Kind::kHeading) residual[0] = wrap_pi(residual[0]);
  const Eigen::Matrix<double, N, kStates> h = predicted.jacobian.template topRows<N>();
  MatrixN s = h * p * h.transpose();
  s.diagonal() += variance;
  const MatrixN s_inverse = s.inverse();  // closed form for 1 and 2 rows
  Innovation out;
  out.size = N;
  out.nis = residual.dot(s_inverse * residual);
  if (!(out.nis <= gate_nis)) return out;  // NaN is refused
  const Eigen::Matrix<double, kStates, N> k = p * h.transpose() * s_inverse;
  x += k * residual;
  x[kYaw] = wrap_pi(x[kYaw]);
  const Matrix6 rest = Matrix6::Identity() - k * h;
  const Matrix6 next = rest * p * rest.transpose() + k * variance.asDiagonal() * k.transpose();
  p = 0.5 * (next + next.transpose());
  out.accepted = true;
  return out;
}

// Where the antenna is in Map, from the centre of gravity: level x, and y and z tilted by the bank.
Eigen::Vector2d arm_in_road(const LeverArm& arm, double bank_rad) {
  return {arm.x_m, arm.y_m * std::cos(bank_rad) + arm.z_m * std::sin(bank_rad)};
}

Predicted position(const Vector6& x, const Measurement& m, const Motion& motion) {
  const Eigen::Vector2d arm = arm_in_road(m.arm, motion.bank_rad);
  const double c = std::cos(x[kYaw]), s = std::sin(x[kYaw]);
  Predicted out;
  out.size = 2;
  out.value << x[kX] + c * arm.x() - s * arm.y(), x[kY] + s * arm.x() + c * arm.y();
  out.jacobian(0, kX) = out.jacobian(1, kY) = 1.0;
  out.jacobian(0, kYaw) = -s * arm.x() - c * arm.y();
  out.jacobian(1, kYaw) = c * arm.x() - s * arm.y();
  return out;
}

Predicted velocity(const Vector6& x, const Measurement& m, const Motion& motion) {
  const Eigen::Vector2d arm = arm_in_road(m.arm, motion.bank_rad);
  const double c = std::cos(x[kYaw]), s = std::sin(x[kYaw]), cb = std::cos(motion.bank_rad);
  const double heading_rate = (motion.yaw_rate_rad_per_s - x[kBias]) / cb;
  const double along = x[kVx] - heading_rate * arm.y();
  const double left = x[kVy] * cb + heading_rate * arm.x();
  Predicted out;
  out.size = 2;
  out.value << c * along - s * left, s * along + c * left;
  out.jacobian.row(0) << 0.0, 0.0, -s * along - c * left, c, -s * cb,
      (c * arm.y() + s * arm.x()) / cb;
  out.jacobian.row(1) << 0.0, 0.0, c * along - s * left, s, c * cb,
      (s * arm.y() - c * arm.x()) / cb;
  return out;
}

Predicted component(const Vector6& x, StateIndex index) {
  Predicted out;
  out.size = 1;
  out.value[0] = x[index];
  out.jacobian(0, index) = 1.0;
  return out;
}

}  // namespace

Vector6 motion_rate(const Vector6& x, const Motion& motion) {
  const double c = std::cos(x[kYaw]), s = std::sin(x[kYaw]), cb = std::cos(motion.bank_rad);
  const double r = motion.yaw_rate_rad_per_s - x[kBias];
  Vector6 rate;
  rate << x[kVx] * c - x[kVy] * cb * s, x[kVx] * s + x[kVy] * cb * c, r / cb,
      motion.fx_mps2 + r * x[kVy],
      motion.fy_mps2 + kGravity_mps2 * std::sin(motion.bank_rad) - r * x[kVx], 0.0;
  return rate;
}

Matrix6 motion_jacobian(const Vector6& x, const Motion& motion) {
  const double c = std::cos(x[kYaw]), s = std::sin(x[kYaw]), cb = std::cos(motion.bank_rad);
  const double r = motion.yaw_rate_rad_per_s - x[kBias];
  Matrix6 a = Matrix6::Zero();
  a(kX, kYaw) = -x[kVx] * s - x[kVy] * cb * c;
  a(kX, kVx) = c;
  a(kX, kVy) = -cb * s;
  a(kY, kYaw) = x[kVx] * c - x[kVy] * cb * s;
  a(kY, kVx) = s;
  a(kY, kVy) = cb * c;
  a(kYaw, kBias) = -1.0 / cb;
  a(kVx, kVy) = r;
  a(kVx, kBias) = -x[kVy];
  a(kVy, kVx) = -r;
  a(kVy, kBias) = x[kVx];
  return a;
}

Predicted predict_measurement(const Vector6& x, const Measurement& m, const Motion& motion) {
  switch (m.kind) {
    case Kind::kPosition:
      return position(x, m, motion);
    case Kind::kVelocity:
      return velocity(x, m, motion);
    case Kind::kHeading:
      return component(x, kYaw);
    case Kind::kWheelSpeed:
      return component(x, kVx);
    case Kind::kSlip:
      return component(x, kVy);
    case Kind::kNone:
    case Kind::kWiden:
    case Kind::kImu:
    case Kind::kRoad:
    case Kind::kAttitude:
      break;
  }
  return {};
}

void advance(Belief& belief, const MotionNoise& noise, Instant to) {
  double left_s = (to - belief.at).seconds();
  belief.at = to;
  if (left_s > kGapMax_s) {
    left_s = kGapMax_s;
    belief.covariance[kX * kStates + kX] += kGapSigma_m * kGapSigma_m;
    belief.covariance[kY * kStates + kY] += kGapSigma_m * kGapSigma_m;
  }
  while (left_s > 0.0) {
    const double dt_s = left_s < kStepMax_s ? left_s : kStepMax_s;
    predict(belief, noise, dt_s);
    left_s -= dt_s;
  }
}

Innovation update(Belief& belief, const Measurement& m, const std::array<double, 2>& gate_nis) {
  if (m.kind == Kind::kWiden) {
    belief.covariance[kX * kStates + kX] += m.sigma_a * m.sigma_a;
    belief.covariance[kY * kStates + kY] += m.sigma_b * m.sigma_b;
    return {.accepted = true, .nis = 0.0, .size = 0};
  }
  const Vector6 x = Eigen::Map<const Vector6>(belief.mean.data());
  const Predicted predicted = predict_measurement(x, m, belief.motion);
  if (predicted.size == 1) return apply<1>(belief, m, predicted, gate_nis[0]);
  if (predicted.size == 2) return apply<2>(belief, m, predicted, gate_nis[1]);
  return {};
}

}  // namespace pitwall::localization
