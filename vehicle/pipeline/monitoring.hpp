// All monitors of the car as one set: what they see in this tick, and, for the bench alone, which
// of them are switched off.
//   in     the outputs of the modules; a set of monitors
//   invariants
//          a monitor belongs to the modules that world/monitor.hpp names beside it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vehicle/pipeline/setup.hpp"
#include "vehicle/pipeline/step.hpp"
#include "vehicle/world/monitor.hpp"

namespace pitwall::pipeline {

world::MonitorSet seen(const Outputs& out, world::MonitorSet by_localization);

// Replaces what was switched off before.
void switch_off(CarParams& params, world::MonitorSet monitors);

}  // namespace pitwall::pipeline
