// Writer of track files in YAML, as parameters::read_track() reads them.
//   in     a TrackDescription, and comment lines for the head of the file (a source, a licence)
//   out    YAML, with degrees for banking and headings
//   invariants
//          read_track(to_yaml(d)) is d within 1e-3 m, 1e-9 1/m, 1e-4 degrees
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "vehicle/world/track_map.hpp"

namespace pitwall::track_file {

std::string to_yaml(const world::TrackDescription& track, const std::vector<std::string>& remarks);

}  // namespace pitwall::track_file
