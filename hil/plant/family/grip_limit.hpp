// What the tyres of a modelled car can do at most, and how much of it a car uses.
//   in     parameters; speed, curvature and banking, or a state as plant::observe() tells it
//   out    largest force of each axle and acceleration of the car; share of the friction ellipse
//   invariants
//          lateral acceleration: of the axle that lets go first, with the load transfer that this
//          acceleration makes; braking: of the axle that locks first with the car's own brake
//          balance, rolling straight. Aerodynamic drag comes on top and is not counted
//   errors none
//   cost   grip_limit(): some ten evaluations of the plant's forces
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/plant/params.hpp"
#include "hil/plant/plant.hpp"

namespace pitwall::plant {

struct Turn {
  double speed_mps = 0.0;
  double curvature_per_m = 0.0;  // of the path over ground, left positive
  double bank_rad = 0.0;
};

struct AxleForces {
  double front_n = 0.0, rear_n = 0.0;
};

struct GripLimit {
  AxleForces lateral, longitudinal;  // each at the limit of its own: an ellipse's half axes
  double lateral_mps2 = 0.0;         // specific force across the car, in the plane of the road
  double braking_mps2 = 0.0;
};

// `grip` scales every friction coefficient, as that of the road.
GripLimit grip_limit(const Params& params, const Turn& turn, double grip = 1.0);

// Of the axle that uses more, with the loads that its wheels have now: 1 at the ellipse. `grip` is
// that of the road; temperature is counted by the law of the plant.
double axle_use(const Params& params, const Truth& truth, double grip = 1.0);

}  // namespace pitwall::plant
