// What a run of the base station heard, as one JSON document.
//   out    packets, lost, refused (total and by kind), rate_hz, age_ms {p50 p90 p99 max}, source,
//          fields: "group.name" -> value (null if never heard), unit, age_ms, quality
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "basestation/intake/link_stats.hpp"
#include "basestation/intake/state_intake.hpp"
#include "basestation/picture/picture.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::outlets {

std::string json_summary(const picture::Picture& picture, const intake::IntakeCounters& counters,
                         const intake::LinkStats& link, Instant now);

}  // namespace pitwall::outlets
