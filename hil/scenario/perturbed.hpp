// Perturbation of the modelled car and its road by a scenario. The car under test does not get it:
// its parameters and its map stay those of its files.
//   in     parameters or road, the perturbations
//   out    the perturbed parameters or road; a neutral perturbation changes no bit
//   invariants
//          mass       added at the same centre of gravity and with the same radius of gyration: the
//                     yaw inertia grows in proportion
//          stiffness  the slope of both tyre curves at zero slip is multiplied by the factor; the
//                     peak keeps its height and moves to a slip that is smaller by the factor
//          friction   multiplies the friction of the road, so that it combines with a grip fault
//          banking    added to that of the track, constant around the lap
//          wind       steady, relative to the ground
//          consumption  the fuel for the same work; drawn by the seed within its spread
//          delays     added to those of the actuators, in front of their lags
//   errors none: the scenario file checks the ranges
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/plant/params.hpp"
#include "hil/plant/plant.hpp"
#include "hil/scenario/scenario.hpp"
#include "hil/sensors/detection_params.hpp"

namespace pitwall::plant {

// The sensors that see other cars, with their noise and, where it asks for them, measured errors of
// the LiDARs.
sensors::DetectionSensors detection_sensors_of(const scenario::Scenario& scenario);

// The car of a scenario, with its tank as filled and its consumption as drawn.
plant::Params plant_of(const scenario::Scenario& scenario);

plant::Params perturbed(const plant::Params& params, const scenario::Perturbations& by);

plant::Surface perturbed(const plant::Surface& road, const scenario::Perturbations& by);

}  // namespace pitwall::plant
