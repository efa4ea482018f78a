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

namespace {

// "name": number pairs, one object.
class JsonCounts {
 public:
  void add(const std::string& name, std::uint64_t value) {
    text_ += (text_.empty() ? "" : ", ") + ("\"" + name + "\": ") + std::to_string(value);
  }
  std::string object() const { return "{" + text_ + "}"; }
  const std::string& pairs() const { return text_; }

 private:
  std::string text_;
};

std::string refusals_json(const world::FrameRefusals& r) {
  JsonCounts out;
  out.add("unknown_id", r.unknown_id);
  out.add("wrong_length", r.wrong_length);
  out.add("remote_or_error", r.remote_or_error);
  out.add("stuck_counter", r.stuck_counter);
  out.add("jumped_counter", r.jumped_counter);
  out.add("not_finite", r.not_finite);
  out.add("out_of_range", r.out_of_range);
  out.add("implausible_slew", r.implausible_slew);
  return out.object();
}

}  // namespace

std::string summary_json(const StepTally& tally, const FrameTotals& frames) {
  JsonCounts out;
  out.add("ticks", tally.steps());
  out.add("missed_deadlines", tally.missed_deadlines());
  out.add("frames_received", frames.received);
  out.add("frames_sent", frames.sent);
  out.add("frames_refused", frames.refused.total());
  out.add("tx_drops", frames.tx_drops);
  out.add("rx_dropped", frames.rx_dropped);
  out.add("gate_refusals", frames.gate_refusals);
  JsonCounts verdicts;
  for (std::size_t i = 0; i < safety::kVerdicts; ++i)
    verdicts.add(safety::text_of(static_cast<safety::Verdict>(i)), frames.gate_verdicts[i]);
  return "{" + out.pairs() + ",\n \"refused_by_kind\": " + refusals_json(frames.refused) +
         ",\n \"gate_verdicts\": " + verdicts.object() +
         ",\n \"step_p50_us\": " + std::to_string(tally.quantile_us(0.5)) +
         ", \"step_p99_us\": " + std::to_string(tally.quantile_us(0.99)) +
         ", \"step_max_us\": " + std::to_string(tally.max_us()) + "}\n";
}

}  // namespace pitwall::io
