// A lap of an oval as the vehicle's state tells it: what `bench codec` has every contestant encode.
//   out    values of all fields of telemetry::kVehicleState, in their ranges; the same each time
//   invariants
//          one motion behind all of it: speeds, accelerations, loads and pressures belong together;
//          what is zero on a car while it drives so (brakes on the straight) is zero
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "protocol/telemetry/registry/vehicle_state.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::codec {

std::vector<telemetry::Values> lap_of(Duration length, Duration step);

}  // namespace pitwall::codec
