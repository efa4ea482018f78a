// Line of minimum curvature between the walls: the closed line whose curvature squared, summed over
// its length, is least.
//   in     the lanes of a track; how far from the walls the middle of the car stays
//   out    waypoints at even stations of the track, close enough for a spline
//   invariants
//          curvature is that of the circle through three neighbours. The sum is made quadratic in
//          the offsets around the last line, solved between the walls, and so on until that
//          lessens it no more
//   errors a road that is narrower than the car with its clearance, with the station; an iteration
//          that does not settle
//   cost   O(length), some 10 ms a kilometre
//   source A. Heilmeier et al., Minimum curvature trajectory planning and control for an autonomous
//          race car, Vehicle System Dynamics 58 (2020), with curvature by finite differences
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/raceline/lanes/lanes.hpp"
#include "vehicle/raceline/lanes/waypoints.hpp"
#include "vehicle/raceline/optimum/offset_line.hpp"

namespace pitwall::raceline {

// The line by its offsets, at stations of which the waypoints are every third.
Result<OffsetLine, Problem> minimum_curvature_offsets(const Lanes& lanes, double margin_m);
std::vector<Waypoint> waypoints_of(const OffsetLine& line);

Result<std::vector<Waypoint>, Problem> minimum_curvature(const Lanes& lanes, double margin_m);

}  // namespace pitwall::raceline
