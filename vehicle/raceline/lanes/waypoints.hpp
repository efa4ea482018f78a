// Waypoints of the lines of a lane, places in the track's own coordinates, and the closed spline
// that is laid through them within the lane.
//   in     lanes of a track; how far from the sides of a lane the car's middle stays
//   out    waypoints by increasing station
//   frames station s, offset n positive left, as in world::TrackMap
//   errors a lane that is narrower than the car with its clearance, or a spline that cannot be kept
//          within it, with the station
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/raceline/lanes/lanes.hpp"
#include "vehicle/raceline/spline/spiro_spline.hpp"

namespace pitwall::raceline {

inline constexpr double kExcessAllowed_m = 0.02;  // of a spline over its margin

struct Waypoint {
  double s_m = kUnset, n_m = kUnset;
};

enum class Side { kInside, kCentre, kOutside };

// Along one side or the middle of a region, closer to each other in turns. `margin_m` is kept to
// both sides of the region.
Result<std::vector<Waypoint>, Problem> parallel_waypoints(const Lanes& lanes, Region region,
                                                          Side side, double margin_m);

// Through the pit lane along its middle, and around the rest of the lap on the inside of the lane
// that it leaves. The track has a pit lane.
Result<std::vector<Waypoint>, Problem> pit_waypoints(const Lanes& lanes, double margin_m);

// The spline through the waypoints, with more of them where it would otherwise come closer than the
// margin to a side of the region.
Result<SpiroSpline, Problem> fit_between(const Lanes& lanes, Region region, double margin_m,
                                         std::vector<Waypoint> waypoints);

}  // namespace pitwall::raceline
