// Check of a speed profile, from a file or from the solver: whether the car can drive it.
//   in     a raceline with a profile, the road of it, the envelope of the car
//   out    the extremes of the profile, each with the arc length where it is
//   invariants
//          refused is a profile with a speed that the tyres do not carry in the corner, or above a
//          cap; an acceleration or a deceleration that the envelope does not have there; speeds,
//          accelerations and times that do not belong together
//   errors Problem with the name of the line and the arc length; the value and what is allowed
//   cost   O(points)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/envelope/envelope_table.hpp"
#include "vehicle/raceline/lanes/raceline.hpp"
#include "vehicle/raceline/profile/lap_road.hpp"

namespace pitwall::raceline {

struct LapFigures {
  double lap_s = kUnset;
  Extreme speed_least{}, speed_most{};  // m/s
  Extreme lateral_use_most{};           // demand over the largest that is carried
};

Result<LapFigures, Problem> check_lap(const Raceline& line, std::span<const RoadStep> road,
                                      const envelope::EnvelopeTable& table);

}  // namespace pitwall::raceline
