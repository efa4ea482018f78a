// Raceline: a closed line around a track at equal steps of its own arc length, and a bank of them.
//   frames Map; curvature positive left; banking positive where the left side is lower
//   units  m, rad, 1/m
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "protocol/vocabulary/units.hpp"
#include "vehicle/raceline/lanes/lanes.hpp"
#include "vehicle/raceline/spline/spiro_spline.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::raceline {

struct RacelinePoint {
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset;
  double curvature_per_m = kUnset, bank_rad = kUnset;
};

struct Raceline {
  std::string name;
  Region region = Region::kInnerLane;  // where the whole car stays
  double length_m = kUnset;
  std::vector<RacelinePoint> points;  // the last one is a step before the first

  double spacing_m() const { return length_m / static_cast<double>(points.size()); }
};

struct RacelineBank {
  std::string track;              // its name, for messages
  std::string track_fingerprint;  // what binds the bank to its track
  std::vector<Raceline> lines;
};

// The spline at steps of at most `step_m`, from the place beside the track's station 0.
Raceline sample_raceline(const SpiroSpline& spline, const world::TrackMap& track, double step_m);

}  // namespace pitwall::raceline
