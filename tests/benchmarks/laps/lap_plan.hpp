// Cases of the lap benchmark: the nominal world and one perturbation at a time. Also the scenario
// of flying laps for a track that has none of its own.
//   in     the track's line with its speed limits (custom_laps)
//   out    perturbations with their names; a Scenario
//   units  as scenario::Perturbations
//   source the sizes (tyre stiffness, friction, mass, wind, banking, delays) are chosen, not
//          measured: by so much a race car differs from its model from one day to the next
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "hil/scenario/scenario.hpp"
#include "vehicle/pipeline/setup.hpp"

namespace pitwall::laps {

// Of flying laps, one for each track.
inline constexpr std::array kScenarios{"hil/scenarios/lvms_flying_lap.yaml",
                                       "hil/scenarios/ims_flying_lap.yaml",
                                       "hil/scenarios/tms_flying_lap.yaml"};

inline constexpr const char* kNominal = "nominal";

struct Case {
  std::string name;
  scenario::Perturbations perturb;
};

// The nominal case is the first one.
std::vector<Case> cases();

// A scenario for any track: engine start and launch 200 m before the line, an out lap, two flying
// laps, a stop. Seed, tyres and the first calls of race control are those of `like`.
scenario::Scenario flying_laps_of(const scenario::Scenario& like, const pipeline::Setup& setup,
                                  const std::string& track_file);

}  // namespace pitwall::laps
