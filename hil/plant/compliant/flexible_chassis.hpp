// What gives way in the compliant car: the body rolls on its springs, the steering yields to its
// tyres, the brake pads have a gap.
//   in     parameters, motion, mass, specific force across the car
//   out    load that moves across each axle; rates of roll and steering flex; working pressure
//   invariants
//          roll: I phi'' = m h ay - K phi - C phi', h from the roll axis to the centre of gravity;
//          an axle shifts (K_i phi + C_i phi' + the force that goes through its roll centre) over
//          its track. In the steady turn both together carry m ay times the whole height. The lean
//          moves no mass sideways and turns no wheel
//          steering: lag d(flex)/dt = compliance x moment - flex; the moment of a lateral force
//          that acts behind the steering axis turns the wheel towards less slip
//          brakes: no torque up to the dead band; pressure falls with a lag of its own
//   source Rill, Road Vehicle Dynamics (2012), 7 and Milliken, Race Car Vehicle Dynamics (1995),
//          16 and 18 (roll axis, load transfer by springs and roll centres); Pacejka, Tire and
//          Vehicle Dynamics (2012), 1.3.3 (effect of steering compliance on understeer)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/plant/dynamics.hpp"

namespace pitwall::plant {

struct LoadShift {  // from the left wheel of an axle to its right one
  double front_n = 0.0, rear_n = 0.0;
};
LoadShift leaning_shift(const Params& params, double mass_kg, const Motion& motion);

double settled_roll_rad(const Params& params, double mass_kg, double ay_mps2);

double pressing_kpa(const Params& params, double pressure_kpa);

// Rates of roll and flex, and of the brakes' pressures where they fall.
void bend(const Params& params, double mass_kg, double ay_mps2, double steering_nm,
          const Motion& motion, const SetPoints& set, Motion& rate);

}  // namespace pitwall::plant
