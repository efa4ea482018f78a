// Model of an inertial measurement unit (IMU) mounted away from the centre of gravity of the car.
//   in     body rates, angular acceleration and specific force at the centre of gravity
//   out    the readings at the place of the unit, with scale factor, turn-on bias and its drift,
//          white noise of the sensor and of the car's vibration; clipped at the range
//   frames Body: ISO 8855, as the driver of the receiver rotates it
//   not modelled  misalignment of the axes, sculling and coning over an interval (a sample is of
//          one instant), quantisation (2^-16 of the usual least bits)
//   source README.md beside this file
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/sensors/gauss_markov.hpp"
#include "hil/sensors/geometry.hpp"
#include "hil/sensors/unit_fault.hpp"
#include "hil/sensors/unit_params.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::sensors {

struct ImuState {
  Vector3 gyro_bias_rad_per_s{}, accel_bias_mps2{};  // turn-on biases
  Vector3 gyro_scale{1.0, 1.0, 1.0}, accel_scale{1.0, 1.0, 1.0};
  GaussMarkov<3> gyro_drift, accel_drift;
  world::ImuSample last;
  bool has_last = false;
};

// Motion of the rigid body at its centre of gravity.
struct Inertial {
  Vector3 rate_rad_per_s{}, change_rad_per_s2{}, specific_force_mps2{};
};

ImuState turn_on(const ImuNoise& noise, Noise& bias);
Vector3 specific_force_at(const Inertial& body, const Lever& place);
world::ImuSample measure(const UnitParams& params, const ImuFault& fault, const Inertial& body,
                         double period_s, ImuState& state, Noise& bias, Noise& white);

}  // namespace pitwall::sensors
