// The single-track car of control: its numbers, as the laws of steering need them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/vocabulary/units.hpp"

namespace pitwall::control {

struct BicycleParams {
  double mass_kg = kUnset;                    // 300..2000, with fuel
  double yaw_inertia_kg_m2 = kUnset;          // 200..5000
  double cg_to_front_m = kUnset;              // 0.5..3
  double cg_to_rear_m = kUnset;               // 0.5..3
  double cornering_front_n_per_rad = kUnset;  // of the axle, both tyres: 2e4..1e6
  double cornering_rear_n_per_rad = kUnset;   // of the axle, both tyres: 2e4..1e6
};

}  // namespace pitwall::control
