// Switching-off of monitors, to prove that each is needed. Only this module writes these
// parameters; the car program only reads them.
//   in     parameters of a loaded car; the monitors to switch off in its run
//   out    the parameters of every module with monitors
//   invariants
//          the new set replaces the previous one
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vehicle/pipeline/setup.hpp"
#include "vehicle/world/monitor.hpp"

namespace pitwall::fault_coverage {

void switch_off(pipeline::CarParams& params, world::MonitorSet monitors);

}  // namespace pitwall::fault_coverage
