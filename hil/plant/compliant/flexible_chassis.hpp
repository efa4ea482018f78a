// Compliance of the modelled car: roll of the body on its springs, flex of the steering under the
// tyre forces, dead band of the brakes.
//   in     parameters, motion, mass, lateral specific force
//   out    load transfer of each axle; rates of roll and steering flex; effective brake pressure
//   invariants
//          roll: I phi'' = m h ay - K phi - C phi', h from the roll axis to the centre of gravity;
//          the load transfer of an axle is (K_i phi + C_i phi' + the moment of the force through
//          its roll centre) over its track. In a steady turn both together carry m ay times the
//          whole height. Roll moves no mass sideways and steers no wheel
//          steering: lag d(flex)/dt = compliance x moment - flex; the moment of a lateral force
//          behind the steering axis turns the wheel towards less slip
//          brakes: no torque up to the dead band; a falling pressure has a lag of its own
//   source Rill, Road Vehicle Dynamics (2012), 7 and Milliken, Race Car Vehicle Dynamics (1995),
//          16 and 18 (roll axis, load transfer by springs and roll centres); Pacejka, Tire and
//          Vehicle Dynamics (2012), 1.3.3 (effect of steering compliance on understeer)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/plant/dynamics.hpp"

namespace pitwall::plant {

struct LoadShift {  // from the left to the right wheel of an axle
  double front_n = 0.0, rear_n = 0.0;
};
LoadShift leaning_shift(const Params& params, double mass_kg, const Motion& motion);

double settled_roll_rad(const Params& params, double mass_kg, double ay_mps2);

double pressing_kpa(const Params& params, double pressure_kpa);

// Writes the rates of roll and flex, and those of the brake pressures where they fall.
void bend(const Params& params, double mass_kg, double ay_mps2, double steering_nm,
          const Motion& motion, const SetPoints& set, Motion& rate);

}  // namespace pitwall::plant
