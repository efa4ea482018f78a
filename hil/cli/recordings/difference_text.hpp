// Differences between a replay and its recording, as text and as JSON.
//   in     differences; the instant at which their times begin
//   units  seconds of the run
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "hil/bench/recorded/comparison.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::cli {

// Three lines each: number of values, the first, the largest.
std::string differences_text(std::span<const bench::SignalDifference> differences, Instant begun);
std::string differences_json(std::span<const bench::SignalDifference> differences, Instant begun);

}  // namespace pitwall::cli
