// All monitors of the car as one set: what they see in this tick.
//   in     the outputs of the modules
//   out    a set of monitors
//   invariants
//          a monitor belongs to the modules that world/monitor.hpp names beside it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vehicle/pipeline/step.hpp"
#include "vehicle/world/monitor.hpp"

namespace pitwall::pipeline {

world::MonitorSet seen(const Outputs& out, world::MonitorSet by_localization);

}  // namespace pitwall::pipeline
