// Switching-off of monitors, to prove that each is needed. Here alone: nothing of the car's program
// writes what it reads of this.
//   in     parameters of a loaded car; the monitors that see nothing in its run
//   out    the parameters of every module that has monitors
//   invariants
//          what was switched off before is replaced
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vehicle/pipeline/setup.hpp"
#include "vehicle/world/monitor.hpp"

namespace pitwall::fault_coverage {

void switch_off(pipeline::CarParams& params, world::MonitorSet monitors);

}  // namespace pitwall::fault_coverage
