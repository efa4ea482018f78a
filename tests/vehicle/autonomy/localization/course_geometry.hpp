// Vectors and matrices of the course of drive.hpp: position, attitude and velocity of the car, and
// the samples of an ideal IMU at its centre of gravity.
//   frames Map; rate and force in Body
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "tests/vehicle/autonomy/localization/drive.hpp"

namespace pitwall::localization::testing {

Eigen::Vector3d place(const Course& c, double t_s);
Eigen::Vector3d left(const Course& c, double t_s);
Eigen::Vector3d velocity(const Course& c, double t_s);
Eigen::Matrix3d attitude(const Course& c, double t_s);  // Body to Map
Eigen::Vector3d rate(const Course& c, double t_s);
Eigen::Vector3d force(const Course& c, double t_s);

}  // namespace pitwall::localization::testing
