// Understeer gradient of a modelled car, measured as on a skid pad.
//   in     parameters of the car
//   out    understeer gradient K: road-wheel angle = curvature (wheelbase + K v^2), in rad per m/s2
//   method the plant runs in neutral with constant steering angle and speed until the turn is
//          steady, at a lateral acceleration in the linear range of the tyres. So K includes the
//          whole model: tyres, loads, compliance and the moment of the differential
//   errors none
//   cost   about a thousand substeps
//   source ISO 4138, method with constant speed; Pacejka, Tire and Vehicle Dynamics (2012), 1.3.3
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/plant/params.hpp"

namespace pitwall::plant {

// The middle of the speeds of the recorded Putnam drive.
inline constexpr double kUndersteerAt_mps = 20.0;

double understeer_of(const Params& params, double speed_mps = kUndersteerAt_mps);

}  // namespace pitwall::plant
