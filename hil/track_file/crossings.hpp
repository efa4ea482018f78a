// Check for crossings of a measured line and its walls.
//   in     the rows that were kept, in order
//   out    the later of the two rows and a sentence with the line number of the other; nullopt if
//          nothing crosses
//   invariants
//          a wall point is at its width, perpendicular to the chord between the two neighbours of a
//          point. Touching counts as crossing, except for segments of one line with a common end.
//          A wall that folds within one turn need not cross: the fit detects this by the radius
//   cost   O(rows^2), bounding boxes first; rows closer than kCrossingStep_m are merged
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hil/track_file/track_csv.hpp"

namespace pitwall::track_file {

inline constexpr double kCrossingStep_m = 4.0;

struct Crossing {
  std::size_t row = 0;
  std::string what;
};

std::optional<Crossing> crossing_of(const TrackCsv& csv, const std::vector<std::size_t>& kept);

}  // namespace pitwall::track_file
