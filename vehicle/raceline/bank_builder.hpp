// The bank of racelines of a track, made of nothing but its file: for each lane a line along its
// inside, its centre and its outside and one by its apexes; the line of minimum curvature between
// the walls; a line through the pit lane.
//   in     a track file and the map that is built of it; the car's width and its clearance; apexes
//          that a person has chosen, for each lane
//   out    lines named "inner/centre", "outer/apex", ..., "track/minimum_curvature", "pit/centre";
//          with a car "track/minimum_time", after the line of minimum curvature
//   invariants
//          each line keeps the clearance to the sides of its region, beside half of the car's width
//   errors a lane that is too narrow, or a spline that cannot be kept within it, with the station
//   cost   about 0.1 s of a processor for an oval; the line of minimum time takes some seconds more
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/envelope/envelope_table.hpp"
#include "vehicle/raceline/lanes/lanes.hpp"
#include "vehicle/raceline/lanes/raceline.hpp"
#include "vehicle/raceline/lanes/waypoints.hpp"

namespace pitwall::raceline {

struct BankParams {
  double car_width_m = kUnset;  // over the wheels
  double clearance_m = 0.3;     // beside the car, to each side of its lane
  double step_m = 1.0;          // between the points of a line, at most
  // The car whose line of minimum time is to be found; null: none, since it takes seconds.
  const envelope::EnvelopeTable* fastest_for = nullptr;
};

// Waypoints at apexes, in place of those that are found; a lane without any finds its own.
struct ChosenApexes {
  std::vector<Waypoint> inner, outer;
};

Result<RacelineBank, Problem> build_bank(const world::TrackDescription& description,
                                         const world::TrackMap& track, const BankParams& params,
                                         const ChosenApexes& chosen = {});

}  // namespace pitwall::raceline
