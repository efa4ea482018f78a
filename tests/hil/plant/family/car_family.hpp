// Family of modelled cars: those of plant files, and any number of randomly drawn ones.
//   in     seed and number of the car; plant files for the first members
//   out    parameters of the plant, and the traits of the car
//   invariants
//          a drawn car has the traits that it states: friction, understeer and all others are drawn
//          uniformly over kFamilyRanges, each from a random stream of its own, and the parameters
//          are solved for them. All other parameters are those of the AV-21. Yaw inertia scales
//          with mass and wheelbase squared; the weight distribution stays; the carcass stiffness of
//          the rear tyres stays, so that with less friction the peak is at a smaller slip; the peak
//          slip angle of the front tyres sets the understeer, all of it with rigid steering, else
//          the half that the compliance of the steering does not cause
//          each structure is drawn with probability 1/2. The AV-21's rear tyres have more
//          longitudinal friction than its front tyres, so that its front wheels always lock first;
//          the tyres of compliant cars have the same friction in both directions, and brake balance
//          decides
//   errors none
//   cost   a drawn car runs the plant for some seconds of its time (understeer_of)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hil/plant/params.hpp"
#include "hil/plant/plant_file.hpp"

namespace pitwall::plant {

struct CarTraits {
  double friction = 0.0;  // grip_limit() on a level road at standstill, lateral, divided by gravity
  double understeer_rad_per_mps2 = 0.0;  // understeer_of()
  double mass_kg = 0.0, wheelbase_m = 0.0;
  double steering_delay_s = 0.0, brake_delay_s = 0.0, throttle_delay_s = 0.0;
  double brake_front_share = 0.0;  // of the braking torque
  double relaxation_m = 0.0;       // of the front tyres; the rear tyres of drawn cars have the same
  double differential_nms_per_rad = 0.0;
  Structure structure = Structure::kDoubleTrack;
};

struct TraitRange {
  double CarTraits::*trait;
  double low, high;
};
// Friction, understeer, mass and wheelbase: range of the cars of the series and their set-ups;
// brake balance: range of the bias knob of the AV-24, extended by the same amount to the front;
// differential: from an open one to that of the AV-21.
inline constexpr TraitRange kFamilyRanges[] = {
    {&CarTraits::friction, 1.0, 1.5},          {&CarTraits::understeer_rad_per_mps2, 0.0, 0.0025},
    {&CarTraits::mass_kg, 700.0, 900.0},       {&CarTraits::wheelbase_m, 2.8, 3.2},
    {&CarTraits::steering_delay_s, 0.0, 0.08}, {&CarTraits::brake_delay_s, 0.0, 0.06},
    {&CarTraits::throttle_delay_s, 0.0, 0.06}, {&CarTraits::brake_front_share, 0.50, 0.66},
    {&CarTraits::relaxation_m, 0.1, 0.5},      {&CarTraits::differential_nms_per_rad, 0.0, 40.0}};

struct FamilyCar {
  std::string name;
  Params params;
  CarTraits traits;
};

CarTraits traits_of(const Params& params);

FamilyCar drawn_car(std::uint64_t seed, std::uint64_t number);

// First the cars of the files unchanged, then drawn ones, `count` in total. The drawn car at an
// index depends only on seed and index.
std::vector<FamilyCar> car_family(std::span<const PlantFile> files, std::uint64_t seed,
                                  std::size_t count);

// One line of text.
std::string to_string(const FamilyCar& car);

}  // namespace pitwall::plant
