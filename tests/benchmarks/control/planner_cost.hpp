// Processor time of planning among cars, at the inputs of a match.
//   in     a loaded scenario; it is driven once, and the inputs of each tick of planning are noted
//   out    p99 over all noted ticks, the best of some blocks; allocations of all of them
//   errors Problem of the run
//   units  processor time of the calling thread
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "hil/bench/loading.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"
#include "tests/benchmarks/cost/cost_gates.hpp"

namespace pitwall::control_bench {

struct PlannerCost {
  std::size_t ticks = 0;
  std::size_t passing = 0;  // of them, in a pass or with one looked for
  std::size_t allocations = 0;
  double tick_p99_us = kUnset;
  double unit_us = 0.0;  // of a reference unit between the blocks
};

Result<PlannerCost, Problem> measure_planner(const bench::Loaded& loaded);

// At most 1 ms for a tick on the reference machine; no allocation; some ticks of a pass.
cost::CostGates gates_of(const PlannerCost& measured);

std::string to_text(const PlannerCost& measured);

}  // namespace pitwall::control_bench
