// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/filter/ekf_3d_model.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/check.hpp"
#include "vehicle/autonomy/localization/filter/rotation.hpp"

namespace pitwall::localization {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using Row3 = Eigen::RowVector3d;

constexpr double kSlowSpeed_mps = 5.0, kSlowSlipSigma_mps = 0.1;  // no side slip to speak of
constexpr double kHeightOverPlane = 2.0;  // how much worse a height is, where nobody says

Matrix3d attitude(const SpatialBelief& b) { return quaternion_of(b).toRotationMatrix(); }
Vector3d rate(const SpatialBelief& b) { return rate_of(b, b.now); }

// Said by the sensor, or else what is assumed.
double sigma_or(double sigma, double otherwise) { return std::isfinite(sigma) ? sigma : otherwise; }

}  // namespace

Vector3d normal_of(const Road& road) {
  const double c = std::cos(road.direction_rad), s = std::sin(road.direction_rad);
  const double ahead = std::tan(road.climb_rad), left = -std::tan(road.bank_rad);
  return Vector3d(-ahead * c + left * s, -ahead * s - left * c, 1.0).normalized();
}

Observation antenna_position(const SpatialBelief& b, const SpatialParams& p, const Measurement& m) {
  CHECK(m.unit < world::kGnssUnits);
  const Vector3d arm = attitude(b) * as_vector(m.arm);
  const double sigma_b = sigma_or(m.sigma_b, sigma_or(m.sigma_a, 0.0)),
               sigma_a = sigma_or(m.sigma_a, sigma_b);
  const Vector3d sigma(sigma_a, sigma_b,
                       sigma_or(m.sigma_c, kHeightOverPlane * std::max(sigma_a, sigma_b)));
  const double share = p.position_wander_share;
  Observation o;
  o.size = std::isfinite(m.c) ? 3 : 2;
  o.residual = Vector3d(m.a, m.b, m.c) - as_vector(b.position_m) - arm -
               share * sigma.cwiseProduct(as_vector(b.wander[m.unit]));
  o.variance = (1.0 - share * share) * sigma.cwiseAbs2();
  o.variance.array() += square(p.position_sigma_floor_m);
  o.jacobian.middleCols<3>(kDp).setIdentity();
  o.jacobian.middleCols<3>(kPhi) = -cross(arm);
  o.jacobian.middleCols<3>(kDw + 3 * m.unit) = (share * sigma).asDiagonal();
  return o;
}

Observation antenna_velocity(const SpatialBelief& b, const SpatialParams& p, const Measurement& m) {
  const Matrix3d r = attitude(b);
  const Vector3d arm = as_vector(m.arm), round = r * rate(b).cross(arm);
  Observation o;
  o.size = std::isfinite(m.c) ? 3 : 2;
  o.residual = Vector3d(m.a, m.b, m.c) - as_vector(b.velocity_mps) - round;
  o.variance = {square(sigma_or(m.sigma_a, p.velocity_sigma_mps)),
                square(sigma_or(m.sigma_b, p.velocity_sigma_mps)),
                square(sigma_or(m.sigma_c, p.vertical_velocity_sigma_mps))};
  o.jacobian.middleCols<3>(kDv).setIdentity();
  o.jacobian.middleCols<3>(kPhi) = -cross(round);
  o.jacobian.middleCols<3>(kDbg) = r * cross(arm);
  o.jacobian.col(kDs) = b.now.rate_rad_per_s[2] * o.jacobian.col(kDbg + 2);
  return o;
}

Observation baseline_heading(const SpatialBelief& b, const SpatialParams& p, const Measurement& m) {
  const Vector3d d =
      attitude(b) * Vector3d(std::cos(m.direction_rad), std::sin(m.direction_rad), 0.0);
  const double level2 = square(d.x()) + square(d.y());
  Observation o;
  o.size = 1;
  o.residual[0] = wrap_pi(m.a + m.direction_rad - std::atan2(d.y(), d.x()));
  o.variance[0] = square(sigma_or(m.sigma_a, 0.0)) + square(p.heading_sigma_floor_rad);
  o.jacobian.block<1, 3>(0, kPhi) = Row3(-d.x() * d.z() / level2, -d.y() * d.z() / level2, 1.0);
  return o;
}

Observation wheel_speed(const SpatialBelief& b, const SpatialParams& p, const Measurement& m) {
  const Vector3d ahead = attitude(b).col(0), v = as_vector(b.velocity_mps);
  Observation o;
  o.size = 1;
  o.residual[0] = m.a - ahead.dot(v);
  o.variance[0] = square(sigma_or(m.sigma_a, p.wheel_sigma_mps)) +
                  square(sigma_or(m.sigma_b, p.wheel_sigma_per_speed) * m.a);
  o.jacobian.block<1, 3>(0, kDv) = ahead.transpose();
  o.jacobian.block<1, 3>(0, kPhi) = ahead.cross(v).transpose();
  return o;
}

Observation rear_slip(const SpatialBelief& b, const SpatialParams& p) {
  const Matrix3d r = attitude(b);
  const Vector3d ahead = r.col(0), left = r.col(1), v = as_vector(b.velocity_mps);
  const double vx = ahead.dot(v), fy = force_of(b, b.now).y();
  const bool slow = std::abs(vx) < kSlowSpeed_mps;
  const double k = slow ? 0.0 : p.rear_slip_rad_per_mps2;
  const Vector3d direction = left + k * fy * ahead;  // what is measured is its part of the velocity
  Observation o;
  o.size = 1;
  o.residual[0] = p.cg_to_rear_m * rate(b).z() - direction.dot(v);
  o.variance[0] = square(slow ? kSlowSlipSigma_mps : p.slip_sigma_mps);
  o.jacobian.block<1, 3>(0, kDv) = direction.transpose();
  o.jacobian.block<1, 3>(0, kPhi) = direction.cross(v).transpose();
  o.jacobian(0, kDbg + 2) = p.cg_to_rear_m;
  o.jacobian(0, kDs) = p.cg_to_rear_m * b.now.rate_rad_per_s[2];
  o.jacobian(0, kDba + 1) = -k * vx;
  o.jacobian(0, kDa) = -k * vx * b.now.force_mps2[1];
  return o;
}

Observation road_tilt(const SpatialBelief& b, const SpatialParams& p, const Road& road) {
  const Matrix3d to_body = attitude(b).transpose();
  const Vector3d normal = normal_of(road);
  Observation o;
  o.size = 2;
  o.residual.head<2>() = -(to_body * normal).head<2>();
  o.variance.head<2>().setConstant(square(p.road_tilt_sigma_rad));
  o.jacobian.block<2, 3>(0, kPhi) = (to_body * cross(normal)).topRows<2>();
  return o;
}

Observation road_height(const SpatialBelief& b, const SpatialParams& p, const Road& road) {
  const Vector3d normal = normal_of(road);
  Observation o;
  o.size = 1;
  o.residual[0] = p.cg_height_m -
                  normal.dot(as_vector(b.position_m) - Vector3d(road.x_m, road.y_m, road.height_m));
  o.variance[0] = square(p.road_height_sigma_m);
  o.jacobian.block<1, 3>(0, kDp) = normal.transpose();
  return o;
}

Observation road_normal(const SpatialBelief& b, const SpatialParams& p, const Road& road) {
  const Vector3d normal = normal_of(road);
  Observation o;
  o.size = 1;
  o.residual[0] = -normal.dot(as_vector(b.velocity_mps));
  o.variance[0] = square(p.road_normal_sigma_mps);
  o.jacobian.block<1, 3>(0, kDv) = normal.transpose();
  return o;
}

Observation receiver_attitude(const SpatialBelief& b, const SpatialParams& p,
                              const Measurement& m) {
  const Eigen::Quaterniond mean = quaternion_of(b);
  const Matrix3d r = mean.toRotationMatrix();
  const bool has_yaw = std::isfinite(m.c);
  const double yaw = has_yaw ? m.c : angles_of(r).yaw_rad;
  const double floor2 = square(p.attitude_sigma_floor_rad);
  Observation o;
  o.size = has_yaw ? 3 : 2;
  o.residual = log_rotation(mean.conjugate() * rotation_of({yaw, m.b, m.a}));
  o.variance = Vector3d(square(sigma_or(m.sigma_a, 0.0)), square(sigma_or(m.sigma_b, 0.0)),
                        square(sigma_or(m.sigma_c, 0.0)));
  o.variance.array() += floor2;
  o.jacobian.middleCols<3>(kPhi) = r.transpose();
  return o;
}

}  // namespace pitwall::localization
