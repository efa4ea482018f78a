// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/tally.hpp"

#include <algorithm>
#include <utility>

namespace pitwall::io {

void StepTally::add(Duration step, std::uint64_t missed_deadlines) {
  const double us = static_cast<double>(step.ns) * 1e-3;
  const auto bin = std::min(kBins - 1, static_cast<std::size_t>(std::max(0.0, us)));
  ++bins_[bin];
  ++steps_;
  missed_ += missed_deadlines;
  max_us_ = std::max(max_us_, us);
  recent_max_us_ = std::max(recent_max_us_, us);
}

double StepTally::take_recent_max_us() { return std::exchange(recent_max_us_, 0.0); }

double StepTally::quantile_us(double q) const {
  const double wanted = q * static_cast<double>(steps_);
  double seen = 0.0;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    seen += bins_[bin];
    if (seen >= wanted && seen > 0.0) return static_cast<double>(bin + 1);
  }
  return 0.0;
}

std::string summary_json(const StepTally& tally, const Rim& rim, const GatewayTotals& totals) {
  const auto count = [](const char* name, std::uint64_t value) {
    return "  \"" + std::string(name) + "\": " + std::to_string(value) + ",\n";
  };
  return "{\n" + count("ticks", tally.steps()) +
         count("missed_deadlines", tally.missed_deadlines()) +
         count("frames_received", rim.can().received) + count("frames_sent", rim.can().sent) +
         count("frames_refused", totals.frames_refused) + count("tx_drops", rim.tx_drops()) +
         count("rx_dropped", rim.can().rx_dropped_queue) +
         count("gate_refusals", totals.gate_refusals) +
         "  \"step_p50_us\": " + std::to_string(tally.quantile_us(0.5)) +
         ",\n  \"step_p99_us\": " + std::to_string(tally.quantile_us(0.99)) +
         ",\n  \"step_max_us\": " + std::to_string(tally.max_us()) + "\n}\n";
}

}  // namespace pitwall::io
