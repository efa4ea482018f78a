// Line of minimum time between the walls: the closed line whose fastest lap, by the envelope of the
// car, is shortest.
//   in     the lanes of a track; how far from the walls the middle of the car stays; the envelope
//   out    waypoints at even stations of the track, close enough for a spline
//   invariants
//          begins with the line of minimum curvature, and is never slower. In each round the lap
//          time is made linear in the offsets, with the square of the changes of curvature added,
//          and solved between the walls; a round that does not lessen the lap time is taken back
//          and the square weighs more. Shifts are left out. That is done for several shares of the
//          curvature squared, which smooths the line; the one with the fastest spline is taken.
//          That is a local minimum. Where a whole lap is limited by its slowest point, as on a ring
//          for a car without drag, the lap time has no slope to follow and the line stays
//   errors those of the line of minimum curvature
//   cost   some seconds a lap
//   source gradient of the lap time by the adjoint of the forward-backward pass
//          (profile/lap_gradient.hpp); steps as in Levenberg-Marquardt: Nocedal and Wright,
//          Numerical Optimization, 2nd ed., chapter 10.3
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/envelope/envelope_table.hpp"
#include "vehicle/raceline/lanes/lanes.hpp"
#include "vehicle/raceline/lanes/waypoints.hpp"

namespace pitwall::raceline {

Result<std::vector<Waypoint>, Problem> minimum_time(const Lanes& lanes, double margin_m,
                                                    const envelope::EnvelopeTable& table);

}  // namespace pitwall::raceline
