// A track file as the base needs it: the drawing that consoles get, and the course that gates and
// ghost use.
//   in     vehicle/config/tracks/*.yaml: stations with curvature and widths
//   out    JSON as PROTOCOL.md has it; a Course
//   frames Map, as ego.x and ego.y
//   invariants
//          the line is integrated from the knots and closed by spreading what is missing evenly: a
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

// Where Map has its origin: WGS 84, height above the ellipsoid.
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
