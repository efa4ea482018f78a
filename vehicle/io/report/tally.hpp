// Counters of the car process, and its summary at the end of a run.
//   units  microseconds; quantiles from a histogram of 1 us up to 4 ms (longer ones count as 4 ms)
//   cost   add(): O(1), no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/quantile.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/safety/frame_gate.hpp"
#include "vehicle/world/health.hpp"

namespace pitwall::io {

class StepTally {
 public:
  // Of a tick that began `late` after its deadline.
  void add(Duration step, Duration late, std::uint64_t missed_deadlines);
  // Largest step time since the last call; for telemetry.
  double take_recent_max_us();
  // Median of the last kRecent steps; unset before the first.
  double recent_median_us() const;

  std::uint64_t steps() const { return steps_; }
  std::uint64_t missed_deadlines() const { return missed_; }
  double quantile_us(double q) const { return bins_us_.quantile(q); }
  double max_us() const { return max_us_; }
  double late_quantile_us(double q) const { return late_us_.quantile(q); }

 private:
  static constexpr std::size_t kBins = 4'000, kRecent = 100;
  Histogram bins_us_{kBins}, late_us_{kBins};
  std::array<float, kRecent> recent_us_{};  // ring buffer
  std::uint64_t steps_ = 0, missed_ = 0;
  double max_us_ = 0.0, recent_max_us_ = 0.0;
};

// List of the detected losses, up to kListed; further ones are only counted.
class LossTally {
 public:
  static constexpr std::size_t kListed = 1'024;

  // Takes the losses of one tick.
  void add(const world::BusHealth& bus);

  std::span<const world::LossReport> listed() const { return listed_.span(); }
  std::uint64_t reports() const { return reports_ + unlisted_; }

 private:
  FixedVector<world::LossReport, kListed> listed_;
  std::uint64_t reports_ = 0;
  std::uint64_t unlisted_ = 0;  // those that did not fit into the list of their tick
};

// Counts since the start.
struct FrameTotals {
  std::uint64_t received = 0, sent = 0, tx_drops = 0, rx_dropped = 0;
  std::uint64_t gate_refusals = 0;
  std::array<std::uint64_t, safety::kVerdicts> gate_verdicts{};  // of the proposed frames
  std::uint64_t missed_shifts = 0;  // asked for and not reported by the gearbox in time
};

// JSON of the parts: radio_json(), receivers_json(), BlackBox::json(), SensorIngress::json() and
// tracking_json().
struct PartTexts {
  std::string radio = "{}", receivers = "[]", recorder = "{}", sensors = "[]";
  std::string tracking = "{}";
};

// One JSON object. `bus` is that of the last tick.
std::string summary_json(const StepTally& tally, const FrameTotals& frames,
                         const world::BusHealth& bus, const LossTally& losses,
                         const PartTexts& parts = {});

}  // namespace pitwall::io
