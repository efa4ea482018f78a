// Throttle map of the engine, both ways: torque at the crankshaft from throttle and engine speed,
// and the throttle for a torque.
//   in     envelope::Engine, engine speed, throttle 0..1 or torque
//   out    torque [Nm], negative at closed throttle; throttle 0..1
//   invariants
//          at each engine speed torque rises with the throttle, linearly between closed (the drag),
//          the rows of part_throttle and full; so each has one inverse, clamped to 0 and 1
//   errors none; is_legal() of engine.hpp says whether the tables are usable
//   cost   O(rows), no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vehicle/envelope/engine.hpp"

namespace pitwall::envelope {

double drag_torque_nm(const Engine& engine, double rpm);  // > 0, at closed throttle
double torque_nm(const Engine& engine, double rpm, double throttle);
double throttle_for(const Engine& engine, double rpm, double torque_nm);

}  // namespace pitwall::envelope
