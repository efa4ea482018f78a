// What each step of the car costs in the closed loop, fed with what a lap feeds it.
//   in     a loaded scenario, which is run kStepRuns times: alike to the bit, so that the least of
//          a tick is what the step costs, and the rest what the machine did to it
//   out    for each tick the least processor time of its step and how far back the filter had to
//          go; allocations in all of them; processor time of the reference unit, taken between the
//          ticks and as the least likewise
//   errors Problem of the run
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "hil/bench/loading.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::benchmarks {

inline constexpr int kStepRuns = 3;

struct StepTime {
  double least_us = 0.0;
  std::optional<Duration> rewind;  // for the latest of what the tick brought; none: nothing late
};

struct StepTimes {
  std::vector<StepTime> steps;
  std::size_t allocations = 0;
  double unit_us = 0.0;
};

Result<StepTimes, Problem> time_steps(const bench::Loaded& loaded);

}  // namespace pitwall::benchmarks
