// What the tracker is given in each tick of a scene, for running it again: frames in the order of
// their measurement, and our own car.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tests/benchmarks/tracking/tracking_plan.hpp"
#include "vehicle/autonomy/tracking/tracking.hpp"

namespace pitwall::tracking_bench {

struct StepLog {
  std::vector<world::EgoState> ego;           // one per tick; its `at` is the tick
  std::vector<world::DetectionFrame> frames;  // sorted by their measurement

  Instant end() const { return ego.back().at; }
};

StepLog log_of(const Scene& scene);

// For each tick the frames that arrive in it, by a rule for the time of arrival (not before the
// measurement). Frames that arrive after the end are left out.
using Ticks = std::vector<std::vector<world::DetectionFrame>>;

template <class Rule>
Ticks arranged(const StepLog& log, Rule arrival) {
  Ticks ticks(log.ego.size());
  std::size_t number = 0;
  for (world::DetectionFrame frame : log.frames) {
    frame.received = arrival(frame, number++);
    std::size_t i = 0;
    const auto after = (frame.received - log.ego.front().at).ns;
    const auto period = (log.ego[1].at - log.ego[0].at).ns;
    if (after > 0) i = static_cast<std::size_t>((after + period - 1) / period);
    if (i < ticks.size()) ticks[i].push_back(frame);
  }
  return ticks;
}

}  // namespace pitwall::tracking_bench
