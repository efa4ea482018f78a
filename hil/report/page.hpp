// Report of one run as one HTML page that needs no network: it contains style, script and plots.
//   in     RunData; the track, if it is known
//   out    the page; its script only adds the read-out under the pointer
//   invariants
//          the same log, result and track give the same bytes: the page contains no time of day, no
//          machine name and no path
//   source readable at 1280 x 800; nothing is marked by colour alone
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/report/run_data.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::report {

// `no_walls`: the reason if there is no track.
std::string page(const RunData& run, const world::TrackMap* track, const std::string& no_walls);

}  // namespace pitwall::report
