// Apexes of a lane: its corners by the curvature of its centre line, and the waypoints of the line
// that goes from the outside of the lane to the inside of each corner and out again.
//   in     the lane's centre line; the offsets of apexes that a person has chosen instead
//   out    apexes and waypoints by increasing station
//   source waypoints at the apexes of a lane: Saba et al., Fast and Modular Autonomy Software for
//          Autonomous Racing Vehicles, section on racelines, where they were placed by hand
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "vehicle/raceline/lanes/lanes.hpp"
#include "vehicle/raceline/lanes/raceline.hpp"
#include "vehicle/raceline/lanes/waypoints.hpp"

namespace pitwall::raceline {

struct Apex {
  double s_m = kUnset;  // station of the track
  bool is_left = true;  // of a left-hand corner
};

// Where the curvature, averaged over 80 m, is largest: between two corners of one direction it
// falls by a fifth. Nothing that is straighter than a radius of 1500 m.
std::vector<Apex> find_apexes(const Raceline& centre, const world::TrackMap& track);

// At the inside of each apex; and where the centre line is straightest between two corners, at the
// outside of both, or in the middle where one is left-hand and the other right-hand. `given` stands
// in place of the waypoints of apexes, unless it is empty.
std::vector<Waypoint> apex_waypoints(const Lanes& lanes, Region region, const Raceline& centre,
                                     double margin_m, const std::vector<Waypoint>& given);

}  // namespace pitwall::raceline
