// Fit of a track file to the rows of a CSV: the reference line made smooth and closed, knots at
// equal steps, walls where they were measured.
//   in     rows (x, y or station, curvature; widths; banking), how far to smooth
//   out    a TrackDescription that world::TrackMap::build() takes, and what was done to the points
//   invariants
//          the smoothed line may lie beside a point: the walls stay where they were, so the widths
//          change by as much. The curvature of a knot is the turn of the line over the step round
//          it, so the lap turns once round exactly. Between two points a wall is straight, and a
//          narrow point is never widened. Banking is the mean over the step round a knot, zero
//          where the file has none; height is only looked at, a track file is flat
//          with stations: the last row is the first one again, one lap on: it says the length
//   units  m, rad, 1/m
//   errors "file:line": a line that is open, crosses itself or has a gap; walls that cross; a turn
//          tighter than its inner wall is far; a point that the smoothed line misses
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/track_file/track_csv.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::track_file {

struct FitOptions {
  std::string name;
  double smoothing_m = 30.0;  // wavelength below which detail of the line goes; not for stations
  double knot_spacing_m = 5.0;
  // Of the origin of x and y, or of the first point where there are only stations.
  double latitude_deg = 0.0, longitude_deg = 0.0, height_m = 0.0;
};

struct Fit {
  world::TrackDescription track;
  std::size_t removed = 0;                   // points that said nothing new
  double moved_m = 0.0, moved_s_m = kUnset;  // farthest from a point to the smoothed line
  double height_range_m = kUnset, gradient_max = kUnset;  // unset without heights
};

Result<Fit, Problem> fit_track(const TrackCsv& csv, const FitOptions& options);

}  // namespace pitwall::track_file
