// Trace of the vehicle state over a lap of an oval: the input that `bench codec` gives to every
// encoding.
//   out    values of all fields of telemetry::kVehicleState, in their ranges; the same at each call
//   invariants
//          all values come from one motion: speeds, accelerations, loads and pressures are
//          consistent; values that are zero on a real car (brakes on the straight) are zero
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "protocol/telemetry/packet/vehicle_state.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::codec {

std::vector<telemetry::Values> lap_of(Duration length, Duration step);

}  // namespace pitwall::codec
