// File of apexes that a person has chosen for the lanes of a track: YAML, lists `inner` and `outer`
// of `{s_m: 640.0, n_m: 2.4}`, station and offset in the track's coordinates. Either may be left
// out.
//   in     the text of the file and its name; the track
//   out    the waypoints by increasing station
//   errors Problem with file:line:column: a key or a number out of place, a station outside of the
//          lap, two apexes closer than 30 m
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/raceline/bank_builder.hpp"

namespace pitwall::raceline {

Result<ChosenApexes, Problem> read_apexes(std::string_view text, const std::string& name,
                                          const world::TrackMap& track);

}  // namespace pitwall::raceline
