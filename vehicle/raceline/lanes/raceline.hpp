// Raceline of a spline: its points at equal steps, with the banking of the road.
//   frames Map
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vehicle/raceline/lanes/lanes.hpp"
#include "vehicle/raceline/spline/spiro_spline.hpp"
#include "vehicle/world/raceline.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::raceline {

using world::LapPoint;
using world::Raceline;
using world::RacelineBank;
using world::RacelinePoint;

// The largest or the smallest of a figure along a line.
struct Extreme {
  double value = kUnset, s_m = kUnset;  // arc length of the line
};

// The spline at steps of at most `step_m`, from the place beside the track's station 0.
Raceline sample_raceline(const SpiroSpline& spline, const world::TrackMap& track, double step_m);

}  // namespace pitwall::raceline
