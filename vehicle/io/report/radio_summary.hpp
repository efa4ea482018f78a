// Summary of the radio's counters over a run, as part of the car's summary.
//   in     the endpoint's report at the end, number of paths
//   out    one JSON object: whole numbers by name, one object for each path
//   units  in the names; times in us
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "protocol/telemetry/endpoint/link_report.hpp"

namespace pitwall::io {

std::string radio_json(const telemetry::LinkReport& report, std::size_t paths);

}  // namespace pitwall::io
