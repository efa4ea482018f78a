// Cost of each step of the car in the closed loop, with the inputs of a lap.
//   in     a loaded scenario. It is run kStepRuns times with equal results to the bit, so the least
//          time of a tick is the cost of its step; the rest is disturbance by the machine
//   out    for each tick the least processor time of its step and the rewind of the filter;
//          allocations in all steps; processor time of the reference unit, measured between the
//          ticks, also as the least
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
  std::optional<Duration> rewind;  // for the oldest measurement of the tick; nullopt: none late
};

struct StepTimes {
  std::vector<StepTime> steps;
  std::size_t allocations = 0;
  double unit_us = 0.0;
};

Result<StepTimes, Problem> time_steps(const bench::Loaded& loaded);

}  // namespace pitwall::benchmarks
