// Motion and measurement models of the planar filter with their Jacobians, as Eigen matrices, for
// ekf.cpp and its tests. Code that only runs the filter needs ekf.hpp alone.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "vehicle/autonomy/localization/filter/ekf.hpp"
#include "vehicle/autonomy/localization/filter/measurement.hpp"

namespace pitwall::localization {

using Vector6 = Eigen::Matrix<double, kStates, 1>;
using Matrix6 = Eigen::Matrix<double, kStates, kStates>;

struct Predicted {
  int size = 0;  // 1 or 2
  Eigen::Vector2d value = Eigen::Vector2d::Zero();
  Eigen::Matrix<double, 2, kStates> jacobian = Eigen::Matrix<double, 2, kStates>::Zero();
};

Vector6 motion_rate(const Vector6& x, const Motion& motion);
Matrix6 motion_jacobian(const Vector6& x, const Motion& motion);  // of motion_rate
Predicted predict_measurement(const Vector6& x, const Measurement& m, const Motion& motion);

}  // namespace pitwall::localization
