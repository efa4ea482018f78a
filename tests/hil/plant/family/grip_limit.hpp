// Grip limit of a modelled car: the largest tyre forces, and the share of them in use.
//   in     parameters; speed, curvature and banking, or a state as plant::observe() returns it
//   out    largest force of each axle and acceleration of the car; share of the friction ellipse
//   invariants
//          lateral acceleration: of the axle that loses grip first, with the load transfer of this
//          acceleration; braking: of the axle that locks first with the car's own brake balance,
//          rolling straight. Aerodynamic drag is not included
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
  AxleForces lateral, longitudinal;  // each at its own limit: the half axes of an ellipse
  double lateral_mps2 = 0.0;         // lateral specific force, in the plane of the road
  double braking_mps2 = 0.0;
};

// `grip` scales every friction coefficient, like the grip of the road.
GripLimit grip_limit(const Params& params, const Turn& turn, double grip = 1.0);

// Used share of the friction ellipse, of the axle that uses more, with the present wheel loads:
// 1 at the limit. `grip` is that of the road; the effect of temperature is included.
double axle_use(const Params& params, const Truth& truth, double grip = 1.0);

}  // namespace pitwall::plant
