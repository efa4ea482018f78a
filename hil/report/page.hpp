// The report of one run as one HTML page that needs no network: style, script and plots are in it.
//   in     RunData; the track, where it is known
//   out    the page; its script only adds the read-out under the pointer
//   invariants
//          the same log, result and track give the same bytes: no clock, no machine, no path
//   source readable at 1280 x 800; colour is never the only sign
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/report/run_data.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::report {

// `no_walls`: why there is no track, where there is none.
std::string page(const RunData& run, const world::TrackMap* track, const std::string& no_walls);

}  // namespace pitwall::report
