// What a run of the base station heard, as one JSON document.
//   out    car ("never heard", "heard", "lost"), packets, lost, refused (total and by kind),
//          rate_hz, age_ms {p50 p90 p99 max}, heartbeats_sent and _not_sent, source,
//          fields: "group.name" -> value (null if never heard), unit, age_ms, quality
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "basestation/intake/station.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::outlets {

std::string json_summary(const intake::Station& station, Instant now);

}  // namespace pitwall::outlets
