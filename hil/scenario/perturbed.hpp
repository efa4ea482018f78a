// The modelled car and its road as a scenario perturbs them. The car under test knows nothing of
// it: its parameters and its map stay those of its files.
//   in     parameters or road, the perturbations
//   out    the same, changed; what is neutral changes no bit
//   invariants
//          mass       added with the same radius of gyration and the same centre of gravity: yaw
//                     inertia grows in proportion
//          stiffness  slope of both tyre curves at zero slip times the factor, the peak as high as
//                     before and at a slip smaller by the factor
//          friction   times that of the road, so a fault of grip composes
//          banking    added to the track's, the same all the way round
//          wind       steady, of the air over ground
//          delays     added to those of the actuators, in front of their lags
//   errors none: the ranges are those of the scenario file
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/plant/params.hpp"
#include "hil/plant/plant.hpp"
#include "hil/scenario/scenario.hpp"

namespace pitwall::plant {

plant::Params perturbed(const plant::Params& params, const scenario::Perturbations& by);

plant::Surface perturbed(const plant::Surface& road, const scenario::Perturbations& by);

}  // namespace pitwall::plant
