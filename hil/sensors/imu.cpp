// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/imu.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pitwall::sensors {
namespace {

// Random walk and vibration over one sample.
double white_sigma(double walk_per_sqrt_s, double vibration, double period_s) {
  return std::hypot(walk_per_sqrt_s / std::sqrt(period_s), vibration);
}

void add_fault(const ImuFault& fault, world::ImuSample& s) {
  for (double& rate : s.rate_rad_per_s) rate *= fault.gyro_scale;
  s.rate_rad_per_s[2] += fault.yaw_rate_bias_rad_per_s;
  s.specific_force_mps2[0] += fault.ahead_bias_mps2;
  s.specific_force_mps2[1] += fault.left_bias_mps2;
}

}  // namespace

ImuState turn_on(const ImuNoise& noise, Noise& bias) {
  ImuState state;
  for (double& b : state.gyro_bias_rad_per_s) b = noise.gyro_turn_on_rad_per_s * bias.normal();
  for (double& b : state.accel_bias_mps2) b = noise.accel_turn_on_mps2 * bias.normal();
  for (double& s : state.gyro_scale) s = 1.0 + noise.gyro_scale * bias.normal();
  for (double& s : state.accel_scale) s = 1.0 + noise.accel_scale * bias.normal();
  state.gyro_drift.begin(bias);
  state.accel_drift.begin(bias);
  return state;
}

Vector3 specific_force_at(const Inertial& body, const Lever& place) {
  const Vector3 r = vector(place);
  return plus(body.specific_force_mps2,
              plus(cross(body.change_rad_per_s2, r),
                   cross(body.rate_rad_per_s, cross(body.rate_rad_per_s, r))));
}

world::ImuSample measure(const UnitParams& params, const ImuFault& fault, const Inertial& body,
                         double period_s, ImuState& state, Noise& bias, Noise& white) {
  const ImuNoise& n = params.noise.imu;
  state.gyro_drift.advance(bias, period_s, n.instability_correlation_s);
  state.accel_drift.advance(bias, period_s, n.instability_correlation_s);
  const double gyro_sigma =
      white_sigma(n.gyro_rad_per_sqrt_s, n.gyro_vibration_rad_per_s, period_s);
  const double accel_sigma = white_sigma(n.accel_mps_per_sqrt_s, n.accel_vibration_mps2, period_s);
  const Vector3 force_mps2 = specific_force_at(body, params.imu);
  world::ImuSample s;
  for (std::size_t i = 0; i < 3; ++i) {
    s.rate_rad_per_s[i] =
        state.gyro_scale[i] * body.rate_rad_per_s[i] + state.gyro_bias_rad_per_s[i] +
        n.gyro_instability_rad_per_s * state.gyro_drift.value[i] + gyro_sigma * white.normal();
    s.specific_force_mps2[i] = state.accel_scale[i] * force_mps2[i] + state.accel_bias_mps2[i] +
                               n.accel_instability_mps2 * state.accel_drift.value[i] +
                               accel_sigma * white.normal();
  }
  add_fault(fault, s);
  for (double& rate : s.rate_rad_per_s)
    rate = std::clamp(rate, -n.gyro_range_rad_per_s, n.gyro_range_rad_per_s);
  for (double& force : s.specific_force_mps2)
    force = std::clamp(force, -n.accel_range_mps2, n.accel_range_mps2);
  if (fault.frozen && state.has_last) s = state.last;
  state.last = s;
  state.has_last = true;
  if (fault.not_a_number)
    s.rate_rad_per_s[2] = s.specific_force_mps2[0] = std::numeric_limits<double>::quiet_NaN();
  return s;
}

}  // namespace pitwall::sensors
