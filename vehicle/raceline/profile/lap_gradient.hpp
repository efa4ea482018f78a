// Gradient of a lap time: how it changes with the curvature and the length of each step of a road.
//   in     a road, the speeds of its fastest lap without shifts, the envelope of the car
//   out    derivative of the lap time by the curvature at each point, and by the way to the next
//   invariants
//          each speed of the profile is that of a corner or cap, of the drive from the point before
//          or of the brakes to the point after; the changes of each are followed back to their
//          origins (the adjoint of the pass). Where two limits meet it is the one of the profile
//   cost   O(points), some 1 us each
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "vehicle/envelope/envelope_table.hpp"
#include "vehicle/raceline/lanes/raceline.hpp"
#include "vehicle/raceline/profile/lap_road.hpp"

namespace pitwall::raceline {

struct LapSlope {
  double by_curvature_s_m = 0.0;  // s per 1/m
  double by_step_s_per_m = 0.0;
};

std::vector<LapSlope> lap_gradient(std::span<const RoadStep> road, std::span<const LapPoint> lap,
                                   const envelope::EnvelopeTable& table);

}  // namespace pitwall::raceline
