// Map of the track in a file.
//   in     track file (YAML)
//   errors Problem with file and line: no such file, no track, none that closes
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::track_file {

Result<world::TrackMap, Problem> read_track_map(const std::string& file);

}  // namespace pitwall::track_file
