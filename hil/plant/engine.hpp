// Engine model: torque and fuel flow from speed and throttle.
//   in     engine speed, rpm; throttle 0..1
//   out    net torque at the crankshaft (negative: friction); fuel flow, kg/s
//   invariants
//          between the throttles of the dyno sheet torque is linear in throttle, and the share of
//          the full torque is linear in speed; from the lowest throttle of the sheet down to closed
//          it falls linearly to pure friction. Above the limiter, fuel is cut over
//          limiter_width_rpm
//   fuel   Willans line: (brake torque + friction) x speed / (efficiency x heating value); none in
//          overrun. L. Guzzella, C. Onder, Introduction to Modeling and Control of Internal
//          Combustion Engine Systems (2010), 2.5
//   errors none: speed and throttle are clamped to the map
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/plant/params.hpp"

namespace pitwall::plant {

double full_throttle_nm(const Engine& engine, double rpm);
double friction_nm(const Engine& engine, double rpm);

double engine_torque_nm(const Engine& engine, double rpm, double throttle_fraction);

double fuel_flow_kgps(const Engine& engine, const Fuel& fuel, double rpm, double torque_nm);

}  // namespace pitwall::plant
