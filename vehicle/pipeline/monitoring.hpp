// Union of the findings of all monitors of the car in one tick.
//   in     the outputs of the modules
//   out    a set of monitors
//   invariants
//          each monitor is reported by the modules that world/monitor.hpp names for it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vehicle/pipeline/step.hpp"
#include "vehicle/world/monitor.hpp"

namespace pitwall::pipeline {

world::MonitorSet seen(const Outputs& out, world::MonitorSet by_localization);

}  // namespace pitwall::pipeline
