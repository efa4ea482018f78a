// Clutch, gear box and the running of the engine.
//   in     the state; what the actuation asks for
//   out    torque at the crankshaft; the discrete state one substep on
//   simplifications  no stall: below launch_rpm the clutch slips, the engine is held at that speed
//          and only a driving torque passes. Gears engage at matched speed. A standing engine is
//          disconnected. Neutral, clutch and gear change pass no torque.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/plant/params.hpp"
#include "hil/plant/plant.hpp"

namespace pitwall::plant {

// Crankshaft speed over mean rear wheel speed; 0 when nothing is engaged.
double total_ratio(const Drivetrain& drivetrain, const State& state);

struct Clutch {
  bool engaged = false;  // rigidly coupled
  double rpm = 0.0;      // of the engine, as far as the clutch decides it
  double crank_torque_nm = 0.0;
};
Clutch clutch_of(const Params& params, const State& state, const Motion& motion);

// Shifts, starts and stops the engine; called once per substep.
void advance_powertrain(const Params& params, const Actuation& actuation, double dt_s,
                        State& state);

}  // namespace pitwall::plant
