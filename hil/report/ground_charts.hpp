// Charts over the track: map of the track, cross-track error over the lap and by speed, g-g
// diagram.
//   in     RunData; the track, if it is known: without it the map has no walls
//   out    HTML: one plot each, or a sentence that says why there is none
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/grading/cross_track.hpp"
#include "hil/report/run_data.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::report {

// `no_walls`: the reason if there is no track.
std::string map_chart(const RunData& run, const world::TrackMap* track,
                      const std::string& no_walls);
std::string station_chart(const RunData& run);
std::string acceleration_chart(const RunData& run);

// Computed as the bench grades it: over every row of the ground truth.
grading::CrossTrack cross_track_of(const RunData& run);
// Bars and table, beside the figures of the real car in the paper.
std::string bracket_chart(const grading::CrossTrack& statistics);
std::string bracket_table(const grading::CrossTrack& statistics);

}  // namespace pitwall::report
