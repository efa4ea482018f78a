// Rotations as 3 x 3 matrices and unit quaternions, with the Z-Y-X angles of ISO 8855.
//   frames R takes Body to Map. Yaw from x counter-clockwise, pitch positive nose down, roll
//          positive left side up
//   invariants
//          exp_rotation(v) is the rotation by |v| about v; log_rotation is its inverse for angles
//          below pi
//   cost   a few tens of floating-point operations; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace pitwall::localization {

inline Eigen::Matrix3d cross(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

inline Eigen::Quaterniond exp_rotation(const Eigen::Vector3d& v) {
  constexpr double kSmall_rad = 1e-6;  // below it the series is exact to double
  const double angle = v.norm();
  const double share =
      angle < kSmall_rad ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
  return {std::cos(0.5 * angle), share * v.x(), share * v.y(), share * v.z()};
}

inline Eigen::Vector3d log_rotation(const Eigen::Quaterniond& q) {
  constexpr double kSmall = 1e-9;
  const double sine = q.vec().norm(), sign = q.w() < 0.0 ? -1.0 : 1.0;
  if (sine < kSmall) return 2.0 * sign * q.vec();
  return (2.0 * std::atan2(sine, sign * q.w()) * sign / sine) * q.vec();
}

struct Angles {
  double yaw_rad, pitch_rad, roll_rad;
};

inline Eigen::Quaterniond rotation_of(const Angles& a) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return AngleAxisd(a.yaw_rad, Vector3d::UnitZ()) * AngleAxisd(a.pitch_rad, Vector3d::UnitY()) *
         AngleAxisd(a.roll_rad, Vector3d::UnitX());
}

inline Angles angles_of(const Eigen::Matrix3d& r) {
  return {std::atan2(r(1, 0), r(0, 0)), std::atan2(-r(2, 0), std::hypot(r(2, 1), r(2, 2))),
          std::atan2(r(2, 1), r(2, 2))};
}

}  // namespace pitwall::localization
