// Raceline: a closed line around a track at equal steps of its own arc length, and the bank of
// them that belongs to one track.
//   frames Map; curvature positive left; banking positive where the left side is lower
//   units  m, rad, 1/m
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::world {

// Part of the road that a line keeps to.
enum class Region : std::uint8_t { kInnerLane, kOuterLane, kPitLane, kTrack };

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
  std::string source = {};  // file, for messages
};

}  // namespace pitwall::world
