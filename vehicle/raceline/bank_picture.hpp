// Picture of a bank of racelines, as SVG: the track from above, the road unrolled along its
// reference line with the lines in their lanes, their curvature, and their speed where they have
// a profile, with the lap times.
//   in     a bank that was made for the track
//   out    one SVG document without scripts; north is up
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "vehicle/raceline/lanes/raceline.hpp"

namespace pitwall::raceline {

std::string picture_of(const RacelineBank& bank, const world::TrackMap& track);

}  // namespace pitwall::raceline
