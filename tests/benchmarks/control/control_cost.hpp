// Processor time of the control laws and of what they are prepared with, at the inputs of a lap.
//   in     a loaded scenario; it is driven once, and each tick of control is noted
//   out    for each law the p99 of a tick, over all noted ticks; the Riccati equations of all
//          brackets; the speed profile of the lap: each the best of some blocks. Allocations of all
//          ticks and of the profile
//   errors Problem of the run; parameters that control refuses
//   units  processor time of the calling thread
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hil/bench/loading.hpp"
#include "protocol/vocabulary/result.hpp"
#include "tests/benchmarks/cost/cost_gates.hpp"
#include "vehicle/autonomy/control/control.hpp"

namespace pitwall::control_bench {

inline constexpr int kCostBlocks = 5;

struct LawCost {
  std::string law;
  double tick_p99_us = kUnset;
};

struct ControlCost {
  std::vector<LawCost> laws;
  std::size_t ticks = 0, profile_points = 0, allocations = 0;
  double prepare_us = kUnset;  // of all laws: the Riccati equations of all speeds
  double profile_us = kUnset;
  double unit_us = 0.0;  // of a reference unit between the blocks
};

Result<ControlCost, Problem> measure_cost(const bench::Loaded& loaded,
                                          const std::vector<std::string>& laws);

// At most 20 us for a tick, 1 ms for the Riccati equations, 2 ms for a lap's profile, each on the
// reference machine; no allocation.
cost::CostGates gates_of(const ControlCost& measured);

std::string to_text(const ControlCost& measured);

}  // namespace pitwall::control_bench
