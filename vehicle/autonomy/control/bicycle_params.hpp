// Parameters of the single-track model that the lateral controller is designed from.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::control {

struct BicycleParams {
  double mass_kg = kUnset;  // with fuel
  double yaw_inertia_kg_m2 = kUnset;
  double cg_to_front_m = kUnset, cg_to_rear_m = kUnset;  // of steering::Bicycle
  double cornering_front_n_per_rad = kUnset;             // of the axle, both tyres
  double cornering_rear_n_per_rad = kUnset;              // of the axle, both tyres
};

inline constexpr auto kBicycleRanges = std::to_array<world::NamedRange<BicycleParams>>({
    {"mass_kg", &BicycleParams::mass_kg, 300.0, 2000.0},
    {"yaw_inertia_kg_m2", &BicycleParams::yaw_inertia_kg_m2, 200.0, 5000.0},
    {"cornering_front_n_per_rad", &BicycleParams::cornering_front_n_per_rad, 2e4, 1e6},
    {"cornering_rear_n_per_rad", &BicycleParams::cornering_rear_n_per_rad, 2e4, 1e6},
});

}  // namespace pitwall::control
