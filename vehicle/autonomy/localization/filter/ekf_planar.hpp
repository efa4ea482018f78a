// Planar filter of the paper, one step of a fold over measurements: ekf.hpp with its noise
// parameters and tyre model. It holds the last IMU sample, has no height and takes the banking from
// the road.
//   invariants
//          lateral speed from the tyre model, only while no receiver gives a velocity:
//            vy = lr r - vx k fy
//          below 5 m/s always: the rear axle does not slip, vy = lr r
//   source Rajamani, Vehicle Dynamics and Control, section 2.5
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "vehicle/autonomy/localization/filter/ekf.hpp"
#include "vehicle/autonomy/localization/filter/measurement.hpp"

namespace pitwall::localization {

struct PlanarParams {
  MotionNoise noise;
  std::array<double, 2> gate_nis{kUnset, kUnset};  // 4..100: for 1 and 2 degrees of freedom
  double position_sigma_floor_m = kUnset;          // covers noise that is correlated in time
  double velocity_sigma_mps = kUnset;
  double heading_sigma_floor_rad = kUnset;
  double wheel_sigma_mps = kUnset;
  double wheel_sigma_per_speed = kUnset;  // share of the speed (slip, tyre growth)
  double slip_sigma_mps = kUnset;         // lateral speed of the tyre model
  double slip_after_s = kUnset;           // the model is used after so long without GNSS velocity
  double cg_to_rear_m = kUnset;
  double rear_slip_rad_per_mps2 = kUnset;  // rear slip angle per lateral acceleration
};

struct PlanarBelief {
  Belief belief;
  Instant velocity_at{};  // last accepted velocity
  bool velocity_received = false;
};

struct PlanarModel {
  using Belief = PlanarBelief;
  using Params = PlanarParams;
  static Innovation fold(PlanarBelief& b, const PlanarParams& p, const Measurement& m,
                         const Measurement* next_imu);
};

}  // namespace pitwall::localization
