// When a sensor measures and how long its result is under way.
//   invariants
//          an epoch comes once, at the first call at or after it; the latency is at least that of
//          the cadence, with an exponential jitter on top that is cut at kJitterMax means
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "hil/sensors/noise.hpp"
#include "hil/sensors/unit_params.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::sensors {

inline constexpr double kJitterMax = 6.0;  // means

// Advances `next` beyond `now`; true if an epoch has come.
inline bool due(Instant now, Duration period, Instant& next) {
  if (now < next) return false;
  while (next <= now) next += period;
  return true;
}

// Mean 1.
inline double exponential(Noise& noise) { return -std::log(1.0 - noise.uniform()); }

inline Duration latency(const Cadence& cadence, Noise& noise) {
  return cadence.latency +
         from_seconds(cadence.jitter_mean_s * std::min(kJitterMax, exponential(noise)));
}

}  // namespace pitwall::sensors
