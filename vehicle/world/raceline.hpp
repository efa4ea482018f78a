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

// Of the speed profile, at a point.
struct LapPoint {
  double speed_mps = kUnset;
  double accel_mps2 = kUnset;  // as far as the next point
  double time_s = kUnset;      // since the first point
  std::uint8_t gear = 0;       // 0: the car's file has no engine
};

struct Raceline {
  std::string name;
  Region region = Region::kInnerLane;  // where the whole car stays
  double length_m = kUnset;
  std::vector<RacelinePoint> points;  // the last one is a step before the first
  std::vector<LapPoint> lap = {};     // of each point; empty without a profile
  double lap_s = kUnset;

  double spacing_m() const { return length_m / static_cast<double>(points.size()); }
};

struct RacelineBank {
  std::string track;              // its name, for messages
  std::string track_fingerprint;  // what binds the bank to its track
  std::vector<Raceline> lines;
  double tyre_share = 1.0;  // of the friction of warm tyres, that the speed profiles are made for
  std::string source = {};  // file, for messages
};

}  // namespace pitwall::world
