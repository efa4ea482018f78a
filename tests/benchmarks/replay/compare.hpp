// Comparison of the frames that arrived on a bus with the log that was played: completeness, order,
// times.
//   in     frames of the log; frames as a recorder received them, with the kernel's stamps
//   out    counts of lost and extra frames, whether the sequence is that of the log, and errors:
//            lateness   arrival minus (zero + stamp of the log since its first one). Zero is chosen
//                       so that the least lateness of the run is 0: start-up and a constant delay
//                       do not count
//            gap error  |gap between two arrivals - gap between their stamps|, in order of the log
//   units  microseconds
//   invariants
//          a stamp that goes back counts as the latest one before it, as in the player
//   errors no timing errors are computed if the sequence is not that of the log
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hil/replay/formats/can_log.hpp"
#include "protocol/can/frame.hpp"

namespace pitwall::replay {

struct Quantiles {
  double p50_us = 0.0, p90_us = 0.0, p99_us = 0.0, max_us = 0.0;
};

// Nearest rank: the least sample that at least this share of the samples does not exceed. Zeros
// without samples.
Quantiles quantiles_of(std::vector<Duration> samples);
// Median of each quantile on its own; for an even number of runs the mean of the two middle values.
Quantiles median_of(std::span<const Quantiles> runs);

struct TimingErrors {
  Quantiles lateness, gap;
};

struct Comparison {
  std::uint64_t wanted = 0, arrived = 0, lost = 0, extra = 0;
  bool in_order = false;  // the whole sequence, frame by frame
  std::optional<TimingErrors> timing{};

  bool complete() const { return lost == 0 && extra == 0; }
};

Comparison compare(std::span<const LoggedFrame> log, std::span<const can::ReceivedFrame> arrived);

}  // namespace pitwall::replay
