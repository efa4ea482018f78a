// Family of modelled cars: those of plant files, and as many as are wanted that are drawn.
//   in     seed and number of the car; plant files for the first members
//   out    parameters of the plant, and what kind of car they make
//   invariants
//          a drawn car has the traits that it states: friction, understeer and all others are
//          drawn evenly over kFamilyRanges, each from a random stream of its own, and the
//          parameters are solved for them. What no trait moves is the AV-21's. Yaw inertia goes
//          with mass and wheelbase squared; the split of the weight stays; the stiffness of the
//          rear tyres' carcass stays, so that with less friction the peak comes at less slip; the
//          front tyres' peak slip angle makes the understeer, with rigid steering all of it, else
//          the half that the compliance of the steering does not make
//          both structures are drawn, each for every second car or so. The AV-21's tyres brake
//          better behind than in front, so that its front wheels always lock first; those of
//          compliant cars have the friction along that they have across, and brake balance decides
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
  double friction = 0.0;                 // grip_limit(): lateral, level, slow, over gravity
  double understeer_rad_per_mps2 = 0.0;  // understeer_of()
  double mass_kg = 0.0, wheelbase_m = 0.0;
  double steering_delay_s = 0.0, brake_delay_s = 0.0, throttle_delay_s = 0.0;
  double brake_front_share = 0.0;  // of the braking torque
  double relaxation_m = 0.0;       // of the front tyres; drawn cars have the same behind
  double differential_nms_per_rad = 0.0;
  Structure structure = Structure::kDoubleTrack;
};

struct TraitRange {
  double CarTraits::*trait;
  double low, high;
};
// Friction, understeer, mass and wheelbase: what cars of the series and their set-ups span; brake
// balance: that of the knob on the AV-24's dash, and as much again to the front; differential: from
// an open one to the AV-21's.
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

// First the cars of the files as they are, then drawn ones, until there are `count`. The drawn car
// at a place depends on seed and place alone.
std::vector<FamilyCar> car_family(std::span<const PlantFile> files, std::uint64_t seed,
                                  std::size_t count);

// One line.
std::string to_string(const FamilyCar& car);

}  // namespace pitwall::plant
