// Picture of a track from above, north up, as SVG of 1280 x 800 for any browser.
//   shows  walls, the road coloured by banking with its legend, reference line, stations every
//          100 m, start line and direction, pit entry and exit, a scale bar, north
//   in     a built track            out  SVG text, which depends on the track alone
//   units  m; one unit of the picture is one pixel
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "vehicle/world/track_map.hpp"

namespace pitwall::track_file {

std::string picture_of(const world::TrackMap& track);

}  // namespace pitwall::track_file
