// Check of a track before a car drives it: figures, and warnings about unusual properties.
//   in     a TrackDescription that world::TrackMap::build() accepts (it refuses invalid tracks:
//          crossing walls, an inner wall beyond the centre of its turn, an open line)
//   out    TrackReport; warnings are sentences with their station
//   invariants
//          closure: distance between end and start of the built line; correction: the largest
//          change of curvature that was needed to close the line, as a share of the largest
//          curvature
//   units  m, rad, 1/m; stations in m
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::track_file {

struct AtStation {
  double value = kUnset, s_m = kUnset;
};

struct TrackReport {
  std::string name;
  std::size_t knots = 0;
  double length_m = kUnset;
  double turned_rad = kUnset;  // over the lap; positive to the left
  double closure_m = kUnset, correction_share = kUnset;
  AtStation curvature_max, curvature_min;  // 1/m, with sign
  AtStation inner_room;                    // m: smallest radius of the inner wall
  AtStation width_max, width_min;          // m, wall to wall
  AtStation wall_nearest;                  // m, from the reference line to a wall
  AtStation bank_max, bank_min;            // rad
  AtStation bank_change, width_change;     // rad/m and m/m, steepest, absolute value
  AtStation curvature_change;              // 1/m^2, steepest, absolute value
  std::vector<std::string> warnings;
};

TrackReport check_track(const world::TrackDescription& description, const world::TrackMap& map);

std::string to_text(const TrackReport& report);
std::string to_json(const TrackReport& report);

}  // namespace pitwall::track_file
