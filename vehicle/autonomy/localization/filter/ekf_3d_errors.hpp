// Errors of the spatial filter as Eigen vectors and matrices, shared by ekf_3d.cpp, the models, the
// update and the seed. Code that only stores a belief needs ekf_3d.hpp alone.
//   frames rates and forces in Body; errors in the order of ErrorIndex
//   cost   no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "vehicle/autonomy/localization/filter/ekf_3d.hpp"

namespace pitwall::localization {

using ErrorVector = Eigen::Matrix<double, kErrors, 1>;
using ErrorMatrix = Eigen::Matrix<double, kErrors, kErrors>;
using ErrorMatrixMap = Eigen::Map<ErrorMatrix>;

inline double square(double x) { return x * x; }

inline Eigen::Map<const Eigen::Vector3d> as_vector(const std::array<double, 3>& a) {
  return Eigen::Map<const Eigen::Vector3d>(a.data());
}
inline Eigen::Map<Eigen::Vector3d> as_vector(std::array<double, 3>& a) {
  return Eigen::Map<Eigen::Vector3d>(a.data());
}
inline Eigen::Vector3d as_vector(const LeverArm& arm) { return {arm.x_m, arm.y_m, arm.z_m}; }

// Body to Map.
inline Eigen::Quaterniond quaternion_of(const SpatialBelief& b) {
  return {b.attitude[0], b.attitude[1], b.attitude[2], b.attitude[3]};
}

// IMU values minus the estimated errors; Body.
Eigen::Vector3d rate_of(const SpatialBelief& b, const Drive& drive);
Eigen::Vector3d force_of(const SpatialBelief& b, const Drive& drive);

// Parts of advance(), one step with constant input: propagation of the mean, and transition matrix
// of its errors.
void integrate(SpatialBelief& b, const Drive& middle, double dt_s);
ErrorMatrix transition(const SpatialBelief& b, const Drive& middle, double dt_s, double wander_s);

// Adds an error to the mean.
void inject(SpatialBelief& b, const ErrorVector& error);
// Adds variance to three errors.
void widen(SpatialBelief& b, ErrorIndex at, const Eigen::Vector3d& sigma);
// Removes the asymmetry of the covariance that rounding causes.
void make_symmetric(SpatialBelief& b);

}  // namespace pitwall::localization
