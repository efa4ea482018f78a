// Faults of sensors, as a scenario names them, carried into the sensor models.
//   in     a fault that is active, now
//   out    what it does to the unit or the wheel; effects of several rows add up
//   invariants
//          a drift, a convergence, a lock grow from the start of their row
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "hil/faults/bench_fault.hpp"
#include "hil/sensors/sensors.hpp"
#include "hil/sensors/wheel_speeds.hpp"

namespace pitwall::bench {

bool is_sensor_fault(faults::BenchFaultKind kind);
// How many equal parts the row's `unit` may name; 1: none.
std::size_t parts_of(faults::BenchFaultKind kind);
// Is the row's value one that the model can take?
bool is_sensor_value(faults::BenchFaultKind kind, double value);

void apply_sensor_fault(const faults::BenchFault& fault, Instant now, sensors::State& receivers,
                        sensors::WheelState& wheels);

}  // namespace pitwall::bench
