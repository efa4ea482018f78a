// Planar extended Kalman filter of the car in the plane of the road: arithmetic only. Models and
// Jacobians are in ekf_model.hpp, the order of measurements in filter_window.hpp.
//   state  x, y [m], yaw [rad] in Map; vx, vy [m/s] of the centre of gravity in Body, in the plane
//          of the road; bias of the yaw gyro [rad/s]
//   invariants
//          with r = gyro - bias and the road banked by phi (left side lower):
//          x' = vx cos yaw - vy cos phi sin yaw      yaw' = r / cos phi
//          y' = vx sin yaw + vy cos phi cos yaw      vx'  = fx + r vy
//          bias' = 0                                 vy'  = fy + g sin phi - r vx
//          where f is the specific force that the IMU measures
//   errors update() refuses an innovation outside its gate and leaves the state unchanged
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/localization/filter/measurement.hpp"

namespace pitwall::localization {

inline constexpr int kStates = 6;
enum StateIndex : int { kX, kY, kYaw, kVx, kVy, kBias };

struct Motion {  // last IMU sample, held until the next
  double yaw_rate_rad_per_s = 0.0;
  double fx_mps2 = 0.0, fy_mps2 = 0.0;
  double bank_rad = 0.0;
};

struct MotionNoise {  // spectral densities: sigma grows with the square root of time
  double gyro_rad_per_sqrt_s = kUnset;
  double accel_mps_per_sqrt_s = kUnset;    // longitudinal
  double lateral_mps_per_sqrt_s = kUnset;  // lateral; includes the error of the banking
  double gyro_bias_rad_per_s_sqrt_s = kUnset;
  double position_m_per_sqrt_s = kUnset;
};

// Plain arrays, so that it is trivially copyable.
struct Belief {
  Instant at{};
  std::array<double, kStates> mean{};
  std::array<double, kStates * kStates> covariance{};
  Motion motion;
};

void advance(Belief& belief, const MotionNoise& noise, Instant to);
// gate_nis[size - 1] is the NIS limit for that size; the covariance update has Joseph's form.
Innovation update(Belief& belief, const Measurement& m, const std::array<double, 2>& gate_nis);

}  // namespace pitwall::localization
