// Track file as the base uses it: the drawing for consoles, and the course for gates and ghost.
//   in     vehicle/config/tracks/*.yaml: stations with curvature and widths
//   out    JSON as PROTOCOL.md describes it; a Course
//   frames Map, as ego.x and ego.y
//   invariants
//          the line is integrated from the knots, and its closing error is spread evenly: a
//          drawing, within a metre of the car's own map
//   errors Problem with file, line and column
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "basestation/state/course.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::publishers::console {

// Origin of Map: WGS 84, height above the ellipsoid.
struct TrackDatum {
  double latitude_deg = kUnset, longitude_deg = kUnset, height_m = kUnset;
};

struct TrackDocument {
  std::string json;
  TrackDatum datum;
  std::optional<state::Course> course;
};

Result<TrackDocument, Problem> read_track(const std::string& path);

}  // namespace pitwall::publishers::console
