// Fingerprint of a track: what binds a bank of racelines to the track that it was made for.
//   in     a track file as it was read: its numbers count, its remarks and layout do not
//   out    SHA-256 as 64 hexadecimal digits
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "vehicle/world/track_map.hpp"

namespace pitwall::raceline {

std::string fingerprint_of(const world::TrackDescription& track);

}  // namespace pitwall::raceline
