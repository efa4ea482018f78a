// Sensor faults of a scenario, applied to the sensor models.
//   in     an active fault, now
//   out    its effect on the unit or the wheel. Of several faults, offsets add up and scale factors
//          multiply; the largest share of gaps and the last fault of a wheel apply
//   invariants
//          a drift, a convergence and a wheel lock grow from the start of the fault
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "hil/faults/bench_fault.hpp"
#include "hil/sensors/sensors.hpp"
#include "hil/sensors/wheel_speeds.hpp"

namespace pitwall::faults {

bool is_sensor_fault(BenchFaultKind kind);
// Number of equal units that `unit` of such a fault selects from; 1: no choice.
std::size_t parts_of(BenchFaultKind kind);
// True if the model accepts this value.
bool is_sensor_value(BenchFaultKind kind, double value);

void apply_sensor_fault(const BenchFault& fault, Instant now, sensors::State& receivers,
                        sensors::WheelState& wheels);

}  // namespace pitwall::faults
