// How the car turns at a steering angle, learned while a gyro says it and held when none does: the
// offset of the sensor of the angle, and the understeer, which depends on tyres and set-up. A tenth
// of a degree at the road wheel is metres in the four seconds after.
//
//     angle = offset + L r / v + K a_y,   a_y = v r - g sin(bank)
//
//   in     angle of the road wheel, yaw rate, speed, g sin(bank); wheelbase and the understeer that
//          the car file has, K0
//   out    the yaw rate in steady state at an angle
//   law    least squares of offset and K over the last kMemory_s, drawn to 0 and K0 by what they
//          may be off (kOffsetSigma_rad, kUndersteerSigma); nothing below kLeastSpeed_mps
//   frames left positive; bank positive where the left side is lower
//   source Rajamani, Vehicle Dynamics and Control, 2nd ed., eq. 3.12
//   cost   O(1)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

namespace pitwall::localization {

struct SteerFit {
  static constexpr double kMemory_s = 20.0, kLeastSpeed_mps = 10.0;
  static constexpr double kOffsetSigma_rad = 0.005, kUndersteerSigma = 0.0005;
  static constexpr double kNoise_rad = 0.001;  // of one second of driving

  double sum_1 = 0.0, sum_a = 0.0, sum_aa = 0.0, sum_y = 0.0, sum_ay = 0.0;
  double offset_rad = 0.0;
  double understeer = 0.0;  // beyond K0, rad per m/s^2
};
static_assert(std::is_trivially_copyable_v<SteerFit>);

struct Steering {
  double wheelbase_m = 0.0, understeer_rad_per_mps2 = 0.0;  // K0
  double angle_rad = 0.0, speed_mps = 0.0, fall_mps2 = 0.0;
};

// One report, `since_s` after the one before, while `rate_rad_per_s` is measured.
void learn(SteerFit& fit, const Steering& steering, double rate_rad_per_s, double since_s);

double yaw_rate_by(const SteerFit& fit, const Steering& steering);

}  // namespace pitwall::localization
