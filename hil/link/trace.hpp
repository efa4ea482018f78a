// Reader and writer of recorded radio links, measured on a track, as CSV files.
//   in     CSV with a header line, one of
//            from_s,to_s[,loss]   outages in order; loss is 1 if it is not given
//            station_m,loss       loss around a station of the track, by ascending station
//          '#' begins a comment line
//   out    a LinkTrace; its loss at a time or station, 0 outside of its entries
//   errors Problem "file:line" for a line that is not such a row, is out of order or out of range
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "hil/link/link_params.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::link {

Result<LinkTrace, Problem> read_trace(std::string_view text, const std::string& name);
// The outages as text of such a file.
std::string write_trace(const LinkTrace& trace);

// The fades that every sender under this seed has, from the start to `length`, one outage for each:
// a trace that can be published and replayed.
LinkTrace trace_of(const Fades& fades, std::uint64_t seed, Duration length);

double loss_over_time(const LinkTrace& trace, Instant at);
double loss_at_station(const LinkTrace& trace, double station_m);

}  // namespace pitwall::link
