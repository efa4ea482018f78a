// Which laps the lap bench drives: the world as the car believes it is, and one thing wrong at a
// time; and the scenario of flying laps for a track that has none of its own.
//   in     the track's line with its speed limits (custom_laps)
//   out    perturbations by name, with how many seconds of what; a Scenario
//   units  as scenario::Perturbations
//   source the spreads: tyre stiffness, friction, mass, wind, banking and delays by which a race
//          car differs from its model from one day to the next; chosen, not measured
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "hil/scenario/scenario.hpp"
#include "vehicle/pipeline/setup.hpp"

namespace pitwall::laps {

struct Case {
  std::string name;
  scenario::Perturbations perturb;
};

// The nominal one first.
std::vector<Case> cases();

// Engine start and launch 200 m before the line, an out lap, two flying laps, a stop: for any
// track. Takes seed, tyres and race control's first calls from `like`.
scenario::Scenario flying_laps_of(const scenario::Scenario& like, const pipeline::Setup& setup,
                                  const std::string& track_file);

}  // namespace pitwall::laps
