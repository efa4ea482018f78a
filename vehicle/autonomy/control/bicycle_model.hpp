// Linear single-track model in path error coordinates, from which the lateral gains are designed.
//   state  e = (e1, e1', e2, e2'): lateral offset [m] of the centre of gravity from the path,
//          positive left, its rate [m/s], heading error [rad] (car minus path), its rate [rad/s]
//   input  road-wheel angle [rad], left positive
//   source Rajamani, Vehicle Dynamics and Control, 2nd ed., eq. 2.45 (cornering stiffness per axle)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "vehicle/autonomy/control/bicycle_params.hpp"

namespace pitwall::control {

using ErrorMatrix = Eigen::Matrix4d;
using ErrorVector = Eigen::Vector4d;

// Requires speed > 0: the model is singular at standstill.
ErrorMatrix error_dynamics(const BicycleParams& car, double speed_mps);
ErrorVector steering_input(const BicycleParams& car);

}  // namespace pitwall::control
