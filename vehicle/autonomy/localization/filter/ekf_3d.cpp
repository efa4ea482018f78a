// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/filter/ekf_3d.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "vehicle/autonomy/localization/filter/ekf_3d_errors.hpp"
#include "vehicle/autonomy/localization/filter/measurement.hpp"
#include "vehicle/autonomy/localization/filter/rotation.hpp"

namespace pitwall::localization {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

static_assert(std::is_trivially_copyable_v<SpatialBelief>);

constexpr double kGapSigma_mps = 30.0;
constexpr double kImuGapMax_s = 0.05;  // from here the car may have done anything in between
constexpr double kBlindGyro_rad_per_sqrt_s = 0.05, kBlindAccel_mps_per_sqrt_s = 3.0;

void set_attitude(SpatialBelief& b, const Eigen::Quaterniond& q) {
  const Eigen::Quaterniond unit = q.normalized();
  b.attitude = {unit.w(), unit.x(), unit.y(), unit.z()};
}

// Fills in what the sample leaves unset: the car neither rolls nor leaves the road, and turns about
// the vertical of the map.
Drive complete(const SpatialBelief& b, const Imu& imu) {
  Drive d{imu.rate_rad_per_s, imu.force_mps2};
  const auto fill = [](double& x, double y) { x = std::isfinite(x) ? x : y; };
  const Matrix3d r = quaternion_of(b).toRotationMatrix();
  const double tan_roll = r(2, 1) / std::max(r(2, 2), 0.1);
  fill(d.rate_rad_per_s[2], b.gyro_bias_rad_per_s[2]);
  const double yaw_rate = d.rate_rad_per_s[2] - b.gyro_bias_rad_per_s[2];
  fill(d.rate_rad_per_s[0], b.gyro_bias_rad_per_s[0]);
  fill(d.rate_rad_per_s[1], b.gyro_bias_rad_per_s[1] + yaw_rate * tan_roll);
  const Vector3d rate = rate_of(b, d);
  const Vector3d steady = rate.cross(r.transpose() * as_vector(b.velocity_mps)) +
                          kGravity_mps2 * r.row(2).transpose() + as_vector(b.accel_bias_mps2);
  for (std::size_t i = 0; i < 3; ++i) fill(d.force_mps2[i], steady[static_cast<Eigen::Index>(i)]);
  return d;
}

bool is_substitute(const Imu& imu) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) sum += imu.rate_rad_per_s[i] + imu.force_mps2[i];
  return !std::isfinite(sum);
}

// As an IMU at the centre of gravity would have measured, but for the change of the rates.
Drive at_centre(const SpatialBelief& b, const Measurement& m) {
  Drive d = complete(b, m.imu);
  const Vector3d rate = rate_of(b, d), arm = as_vector(m.arm);
  as_vector(d.force_mps2) -= rate.cross(rate.cross(arm));
  return d;
}

Drive between(const Drive& a, const Drive& b, double share) {
  Drive d;
  for (std::size_t i = 0; i < 3; ++i) {
    d.rate_rad_per_s[i] = a.rate_rad_per_s[i] + share * (b.rate_rad_per_s[i] - a.rate_rad_per_s[i]);
    d.force_mps2[i] = a.force_mps2[i] + share * (b.force_mps2[i] - a.force_mps2[i]);
  }
  return d;
}

// What drives the state from the newest IMU sample on.
struct Course {
  Drive from, to;
  Instant from_at{};
  double length_s = 0.0;  // zero: held
  bool blind = false;

  Drive at(Instant t) const {
    if (length_s <= 0.0) return from;
    return between(from, to, std::clamp((t - from_at).seconds() / length_s, 0.0, 1.0));
  }
};

Course course_of(const SpatialBelief& b, const Measurement* next_imu, Instant until) {
  Course c;
  if (!b.imu_received) {
    c.from = next_imu == nullptr ? complete(b, {}) : at_centre(b, *next_imu);
    c.blind = true;
    return c;
  }
  c.from = b.last_imu;
  c.from_at = b.last_imu_at;
  c.blind = b.imu_is_substitute;
  if (next_imu == nullptr) {
    c.blind = c.blind || (until - c.from_at).seconds() > kImuGapMax_s;
    return c;
  }
  c.to = at_centre(b, *next_imu);
  c.length_s = (next_imu->at - c.from_at).seconds();
  c.blind = c.blind || is_substitute(next_imu->imu) || c.length_s > kImuGapMax_s;
  if (c.blind || c.length_s <= 0.0) return c;
  const Vector3d change =
      (as_vector(c.to.rate_rad_per_s) - as_vector(c.from.rate_rad_per_s)) / c.length_s;
  as_vector(c.from.force_mps2) -= change.cross(as_vector(b.last_imu_arm));
  as_vector(c.to.force_mps2) -= change.cross(as_vector(next_imu->arm));
  return c;
}

// The blocks of the transition that are neither zero nor one.
struct Blocks {
  Matrix3d p_phi, p_ba, v_phi, v_bg, v_ba, phi_bg;
  Vector3d v_s, phi_s, p_a, v_a;
};

Blocks blocks_of(const SpatialBelief& b, const Drive& middle, double dt_s) {
  const Vector3d rate = rate_of(b, middle), force = force_of(b, middle);
  const Matrix3d r = (quaternion_of(b) * exp_rotation(0.5 * dt_s * rate)).toRotationMatrix();
  Blocks f;
  f.v_phi = -dt_s * cross(r * force);
  f.p_phi = 0.5 * dt_s * f.v_phi;
  f.phi_bg = -dt_s * r;
  f.v_bg = 0.5 * f.v_phi * f.phi_bg;
  f.v_ba = -dt_s * r;
  f.p_ba = 0.5 * dt_s * f.v_ba;
  f.phi_s = middle.rate_rad_per_s[2] * f.phi_bg.col(2);
  f.v_s = 0.5 * f.v_phi * f.phi_s;
  f.v_a = middle.force_mps2[1] * f.v_ba.col(1);
  f.p_a = 0.5 * dt_s * f.v_a;
  return f;
}

// P = F P F^T, block by block: first the rows, then the columns.
void transform(ErrorMatrixMap& p, const Blocks& f, double dt_s, double keep) {
  p.middleRows<3>(kDp) += dt_s * p.middleRows<3>(kDv) + f.p_phi * p.middleRows<3>(kPhi) +
                          f.p_ba * p.middleRows<3>(kDba) + f.p_a * p.row(kDa);
  p.middleRows<3>(kDv) += f.v_phi * p.middleRows<3>(kPhi) + f.v_bg * p.middleRows<3>(kDbg) +
                          f.v_ba * p.middleRows<3>(kDba) + f.v_s * p.row(kDs) + f.v_a * p.row(kDa);
  p.middleRows<3>(kPhi) += f.phi_bg * p.middleRows<3>(kDbg) + f.phi_s * p.row(kDs);
  p.middleRows<6>(kDw) *= keep;
  p.middleCols<3>(kDp) +=
      dt_s * p.middleCols<3>(kDv) + p.middleCols<3>(kPhi) * f.p_phi.transpose() +
      p.middleCols<3>(kDba) * f.p_ba.transpose() + p.col(kDa) * f.p_a.transpose();
  p.middleCols<3>(kDv) += p.middleCols<3>(kPhi) * f.v_phi.transpose() +
                          p.middleCols<3>(kDbg) * f.v_bg.transpose() +
                          p.middleCols<3>(kDba) * f.v_ba.transpose() +
                          p.col(kDs) * f.v_s.transpose() + p.col(kDa) * f.v_a.transpose();
  p.middleCols<3>(kPhi) +=
      p.middleCols<3>(kDbg) * f.phi_bg.transpose() + p.col(kDs) * f.phi_s.transpose();
  p.middleCols<6>(kDw) *= keep;
}

// Both receivers see the same sky: a part of what they stray is common.
void add_wander(ErrorMatrixMap& p, double variance, double together) {
  p.diagonal().segment<6>(kDw).array() += variance;
  for (int i = kDw; i < kDw + 3; ++i) {
    p(i, i + 3) += together * variance;
    p(i + 3, i) = p(i, i + 3);
  }
}

void predict(SpatialBelief& b, const SpatialParams& params, const Drive& middle, bool blind,
             double dt_s) {
  ErrorMatrixMap p(b.covariance.data());
  const double keep = std::exp(-dt_s / params.position_wander_s);
  transform(p, blocks_of(b, middle, dt_s), dt_s, keep);
  make_symmetric(b);
  const auto add = [&](ErrorIndex at, double density) {
    p.diagonal().segment<3>(at).array() += square(density) * dt_s;
  };
  add(kPhi, blind ? kBlindGyro_rad_per_sqrt_s : params.gyro_rad_per_sqrt_s);
  add(kDv, blind ? kBlindAccel_mps_per_sqrt_s : params.accel_mps_per_sqrt_s);
  add(kDbg, params.gyro_bias_rad_per_s_sqrt_s);
  add(kDba, params.accel_bias_mps2_sqrt_s);
  add_wander(p, 1.0 - keep * keep, params.position_wander_together);
  integrate(b, middle, dt_s);
  for (auto& wander : b.wander) as_vector(wander) *= keep;
}

// Another IMU has other biases.
void apply_unit(SpatialBelief& b, const SpatialParams& p, std::uint8_t unit) {
  if (b.last_imu_unit == unit) return;
  b.last_imu_unit = unit;
  ErrorMatrixMap cov(b.covariance.data());
  const auto forget = [&cov](int at, int count, double sigma) {
    cov.middleRows(at, count).setZero();
    cov.middleCols(at, count).setZero();
    cov.diagonal().segment(at, count).setConstant(square(sigma));
  };
  forget(kDbg, 3, p.gyro_bias_start_rad_per_s);
  forget(kDba, 3, p.accel_bias_start_mps2);
  forget(kDs, 1, p.gyro_scale_start);
  forget(kDa, 1, p.accel_scale_start);
  b.gyro_bias_rad_per_s = b.accel_bias_mps2 = {};
  b.gyro_scale = b.accel_scale = 0.0;
}

}  // namespace

Vector3d rate_of(const SpatialBelief& b, const Drive& d) {
  Vector3d rate = as_vector(d.rate_rad_per_s) - as_vector(b.gyro_bias_rad_per_s);
  rate.z() -= b.gyro_scale * d.rate_rad_per_s[2];
  return rate;
}

Vector3d force_of(const SpatialBelief& b, const Drive& d) {
  Vector3d force = as_vector(d.force_mps2) - as_vector(b.accel_bias_mps2);
  force.y() -= b.accel_scale * d.force_mps2[1];
  return force;
}

void make_symmetric(SpatialBelief& b) {
  ErrorMatrixMap p(b.covariance.data());
  for (int j = 1; j < kErrors; ++j)
    for (int i = 0; i < j; ++i) p(j, i) = p(i, j) = 0.5 * (p(i, j) + p(j, i));
}

void widen(SpatialBelief& b, ErrorIndex at, const Vector3d& sigma) {
  ErrorMatrixMap(b.covariance.data()).diagonal().segment<3>(at) += sigma.cwiseAbs2();
}

void integrate(SpatialBelief& b, const Drive& middle, double dt_s) {
  const Vector3d rate = rate_of(b, middle), force = force_of(b, middle);
  const Eigen::Quaterniond q = quaternion_of(b);
  const Vector3d accel =
      q * exp_rotation(0.5 * dt_s * rate) * force - Vector3d(0.0, 0.0, kGravity_mps2);
  as_vector(b.position_m) += dt_s * (as_vector(b.velocity_mps) + 0.5 * dt_s * accel);
  as_vector(b.velocity_mps) += dt_s * accel;
  set_attitude(b, q * exp_rotation(dt_s * rate));
}

void inject(SpatialBelief& b, const ErrorVector& error) {
  as_vector(b.position_m) += error.segment<3>(kDp);
  set_attitude(b, exp_rotation(error.segment<3>(kPhi)) * quaternion_of(b));
  as_vector(b.velocity_mps) += error.segment<3>(kDv);
  as_vector(b.gyro_bias_rad_per_s) += error.segment<3>(kDbg);
  as_vector(b.accel_bias_mps2) += error.segment<3>(kDba);
  for (std::size_t u = 0; u < b.wander.size(); ++u)
    as_vector(b.wander[u]) += error.segment<3>(kDw + 3 * static_cast<Eigen::Index>(u));
  b.gyro_scale += error[kDs];
  b.accel_scale += error[kDa];
}

ErrorMatrix transition(const SpatialBelief& b, const Drive& middle, double dt_s, double wander_s) {
  const Blocks f = blocks_of(b, middle, dt_s);
  ErrorMatrix t = ErrorMatrix::Identity();
  t.block<3, 3>(kDp, kDv) = dt_s * Matrix3d::Identity();
  t.block<3, 3>(kDp, kPhi) = f.p_phi;
  t.block<3, 3>(kDp, kDba) = f.p_ba;
  t.block<3, 3>(kDv, kPhi) = f.v_phi;
  t.block<3, 3>(kDv, kDbg) = f.v_bg;
  t.block<3, 3>(kDv, kDba) = f.v_ba;
  t.block<3, 3>(kPhi, kDbg) = f.phi_bg;
  t.block<3, 1>(kDv, kDs) = f.v_s;
  t.block<3, 1>(kPhi, kDs) = f.phi_s;
  t.block<3, 1>(kDp, kDa) = f.p_a;
  t.block<3, 1>(kDv, kDa) = f.v_a;
  t.block<6, 6>(kDw, kDw) *= std::exp(-dt_s / wander_s);
  return t;
}

void advance(SpatialBelief& b, const SpatialParams& p, Instant to, const Measurement* next_imu) {
  double left_s = (to - b.at).seconds();
  if (left_s <= 0.0) return;
  if (left_s > kGapMax_s) {
    widen(b, kDp, Vector3d::Constant(kGapSigma_m));
    widen(b, kDv, Vector3d::Constant(kGapSigma_mps));
    left_s = kGapMax_s;
  }
  const Course course = course_of(b, next_imu, to);
  while (left_s > 0.0) {
    const double dt_s = std::min(left_s, kStepMax_s);
    const Instant middle = to - from_seconds(left_s - 0.5 * dt_s);
    predict(b, p, course.at(middle), course.blind, dt_s);
    left_s -= dt_s;
  }
  b.at = to;
  b.now = course.at(to);
}

void apply_imu(SpatialBelief& b, const SpatialParams& p, const Measurement& m) {
  b.imu_is_substitute = is_substitute(m.imu);
  if (!b.imu_is_substitute) apply_unit(b, p, m.unit);
  b.last_imu = b.now = at_centre(b, m);
  b.last_imu_at = m.at;
  b.last_imu_arm = m.arm;
  b.imu_received = true;
}

}  // namespace pitwall::localization
