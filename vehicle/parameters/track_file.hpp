// Reader of track files (vehicle/config/tracks/*.yaml): degrees in the file, radians in the result.
//   in     the text of the file and its name, for messages
//   out    the description that world::TrackMap::build() takes
//   errors a missing, unknown, repeated or out-of-range key, with "file:line:column"; build()
//          checks whether the table describes a track
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::parameters {

Result<world::TrackDescription, Problem> read_track(std::string_view text, const std::string& name);

}  // namespace pitwall::parameters
