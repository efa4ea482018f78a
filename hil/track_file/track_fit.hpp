// Fit of a track file to the rows of a CSV: a smooth and closed reference line, knots at equal
// steps, walls where they were measured.
//   in     rows (x, y or station, curvature; widths; banking), the smoothing wavelength
//   out    a TrackDescription that world::TrackMap::build() accepts, and the changes to the points
//   invariants
//          if the smoothed line is beside a point, the walls stay where they were measured, so the
//          widths change by the offset. The curvature of a knot is the turn of the line over the
//          step around it, so the lap makes exactly one turn. Between two points a wall is
//          straight, and a narrow point is never widened. Banking is the mean over the step around
//          a knot, zero if the file has none. Heights are only reported: a track file is flat
//          with stations the last row repeats the first one, one lap later: its station is the
//          length of the lap
//   units  m, rad, 1/m
//   errors "file:line": a line that is open, crosses itself or has a gap; walls that cross; a turn
//          whose radius is smaller than the distance to its inner wall; a point too far from the
//          smoothed line
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/track_file/track_csv.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::track_file {

struct FitOptions {
  std::string name;
  double smoothing_m = 30.0;  // cutoff wavelength for details of the line; unused with stations
  double knot_spacing_m = 5.0;
  // Position of the origin of x and y, or of the first point if there are only stations.
  double latitude_deg = 0.0, longitude_deg = 0.0, height_m = 0.0;
};

struct Fit {
  world::TrackDescription track;
  std::size_t removed = 0;                   // redundant points
  double moved_m = 0.0, moved_s_m = kUnset;  // largest distance from a point to the smoothed line
  double height_range_m = kUnset, gradient_max = kUnset;  // unset without heights
};

Result<Fit, Problem> fit_track(const TrackCsv& csv, const FitOptions& options);

}  // namespace pitwall::track_file
