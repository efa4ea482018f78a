// Measurement models of the spatial filter: innovation and its derivative with respect to the
// errors of the state.
//   out    Observation: residual r = z - h(x), its derivative -dr/d(error), white variance
//   frames residuals of receivers in Map, of models in Body
//   invariants
//          antenna: p + R l + share sigma w_u;  v + R (w - bg) x l
//          baseline b: atan2((R b)_y, (R b)_x)
//          rear tyres: vy = lr r - vx k fy (Rajamani, section 2.5); below 5 m/s vy = lr r
//          road with normal N: R^T N = e_z, N (p - road) = height of the centre of gravity, N v = 0
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "vehicle/autonomy/localization/filter/ekf_3d_errors.hpp"
#include "vehicle/autonomy/localization/filter/measurement.hpp"

namespace pitwall::localization {

struct Observation {
  int size = 0;  // 1..3; the rest is not used
  Eigen::Vector3d residual = Eigen::Vector3d::Zero(), variance = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, kErrors> jacobian = Eigen::Matrix<double, 3, kErrors>::Zero();
};

// Unit normal of the road surface in Map, upwards.
Eigen::Vector3d normal_of(const Road& road);

Observation antenna_position(const SpatialBelief& b, const SpatialParams& p, const Measurement& m);
Observation antenna_velocity(const SpatialBelief& b, const SpatialParams& p, const Measurement& m);
Observation baseline_heading(const SpatialBelief& b, const SpatialParams& p, const Measurement& m);
Observation wheel_speed(const SpatialBelief& b, const SpatialParams& p, const Measurement& m);
Observation rear_slip(const SpatialBelief& b, const SpatialParams& p);
Observation road_tilt(const SpatialBelief& b, const SpatialParams& p, const Road& road);
Observation road_height(const SpatialBelief& b, const SpatialParams& p, const Road& road);
Observation road_normal(const SpatialBelief& b, const SpatialParams& p, const Road& road);
Observation receiver_attitude(const SpatialBelief& b, const SpatialParams& p, const Measurement& m);

}  // namespace pitwall::localization
