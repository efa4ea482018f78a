// Raceline: a closed line around a track at equal steps of its own arc length, and a bank of them.
//   frames Map; curvature positive left; banking positive where the left side is lower
//   units  m, rad, 1/m
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
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

struct Extreme {
  double value = kUnset, s_m = kUnset;  // arc length of the line
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
  std::vector<LapPoint> lap;          // of each point; empty without a profile
  double lap_s = kUnset;

  double spacing_m() const { return length_m / static_cast<double>(points.size()); }
};

struct RacelineBank {
  std::string track;              // its name, for messages
  std::string track_fingerprint;  // what binds the bank to its track
  std::vector<Raceline> lines;
  double tyre_share = 1.0;  // of the friction of warm tyres, that the speed profiles are made for
};

// The spline at steps of at most `step_m`, from the place beside the track's station 0.
Raceline sample_raceline(const SpiroSpline& spline, const world::TrackMap& track, double step_m);

}  // namespace pitwall::raceline
