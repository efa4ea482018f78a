// What the car process leaves behind when it stops: its --summary file, a JSON object.
//   errors Problem with the place in the file
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::bench {

struct CarSummary {
  using Counts = std::vector<std::pair<std::string, std::uint64_t>>;

  std::uint64_t ticks = 0, missed_deadlines = 0;
  std::uint64_t frames_received = 0, frames_sent = 0, frames_refused = 0, tx_drops = 0;
  std::uint64_t rx_dropped = 0, gate_refusals = 0;
  Counts refused_by_kind, gate_verdicts;
  double step_p50_us = kUnset, step_p99_us = kUnset, step_max_us = kUnset;
};

Result<CarSummary, Problem> read_car_summary(const std::string& path);

}  // namespace pitwall::bench
