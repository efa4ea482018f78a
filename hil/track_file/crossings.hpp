// Crossings of a measured line and its walls.
//   in     the rows that were kept, in order
//   out    the later of the two rows and a sentence that names the line of the other; nothing where
//          all is apart
//   invariants
//          walls lie at their width square to the line through a point's two neighbours. Touching
//          is crossing, but for pieces of one line that share an end. A wall that folds within one
//          turn need not cross: that is for the fit to see, from the turn's radius
//   cost   O(rows^2), with boxes first; rows closer than kCrossingStep_m are taken together
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
