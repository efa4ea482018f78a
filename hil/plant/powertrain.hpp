// Powertrain of the modelled car: clutch, gearbox, start and stop of the engine.
//   in     the state; the commands of the actuation
//   out    torque at the crankshaft; the discrete state after one substep
//   simplifications  no stall: below launch_rpm the clutch slips, the engine is held at that speed
//                    and only a driving torque is transmitted. Gears engage at matched speed. A
//                    stopped engine is disconnected. Neutral and a gear change transmit no torque.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/plant/params.hpp"
#include "hil/plant/plant.hpp"

namespace pitwall::plant {

// Ratio of crankshaft speed to mean rear wheel speed; 0 if no gear is engaged.
double total_ratio(const Drivetrain& drivetrain, const State& state);

struct Clutch {
  bool engaged = false;  // rigidly coupled
  double rpm = 0.0;      // engine speed that the clutch determines
  double crank_torque_nm = 0.0;
};
Clutch clutch_of(const Params& params, const State& state, const Motion& motion);

// Shifts gears, starts and stops the engine; to be called once per substep.
void advance_powertrain(const Params& params, const Actuation& actuation, double dt_s,
                        State& state);

}  // namespace pitwall::plant
