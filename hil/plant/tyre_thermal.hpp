// Temperature of a tyre: one lump that friction heats and air cools, and the grip that it has.
// Unvalidated: no measurements of such a tyre are published. What is tested is the balance of
// energy and the shape of the law, not that a real tyre follows it.
//   in     temperature, friction power in the contact patch, speed of the car
//   out    rate of the temperature, K/s; factor on the friction coefficient, 0..1
//   invariants
//          C dT/dt = heat share x friction power - (cooling at rest + by speed) x (T - ambient)
//          grip: 1 from working_c to hot_c; falls linearly by cold_grip_loss down to ambient, and
//          by hot_grip_loss up to ruined_c; constant beyond both
//   errors none
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "hil/plant/params.hpp"

namespace pitwall::plant {

// For reports that show a temperature or a verdict that hangs on one.
inline constexpr std::string_view kTyreThermalCaveat =
    "tyre temperatures and the grip that follows them: unvalidated model (no measurements are "
    "published); only its energy balance is tested";

double thermal_grip(const TyreThermal& thermal, double tyre_c);

double warming_kps(const TyreThermal& thermal, double tyre_c, double friction_w, double speed_mps);

}  // namespace pitwall::plant
