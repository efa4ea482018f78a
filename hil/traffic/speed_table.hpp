// Speed of a ghost over the station.
//   in     speeds at stations, linear between them and closed around the lap, times a share; the
//          deceleration that the car has
//   out    the speed at a station, with which the car is in time at every lower speed ahead
//   invariants
//          never above the given speeds; along the reference line it falls by no more than the
//          deceleration
//   cost   at() O(1), no allocation; a constant speed has no table
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/raceline.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::traffic {

struct SpeedKnot {
  double s_m = kUnset, mps = kUnset;
};

class SpeedTable {
 public:
  explicit SpeedTable(double mps) : squares_{mps * mps} {}
  // The knots rise, and lie within the lap; at least one.
  SpeedTable(const std::vector<SpeedKnot>& knots, double length_m, double brake_mps2);

  double at(double s_m) const;  // s in [0, length)

 private:
  std::vector<double> squares_;  // of the speeds, at equal steps of the lap
  double step_m_ = 0.0;
};

// The lap of a line with a speed profile, each speed times the share.
std::vector<SpeedKnot> lap_of(const world::Raceline& line, const world::TrackMap& track,
                              double share);

}  // namespace pitwall::traffic
