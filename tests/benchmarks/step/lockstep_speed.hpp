// Cost of the lockstep bench on this machine: processor time of the one thread that runs it.
//   in     a loaded scenario; whether the event log is produced too (its bytes are discarded)
//   out    processor time of a simulated second, and of the reference unit, which is measured twice
//          in each of them and not included
//   errors Problem of the run
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "hil/bench/loading.hpp"
#include "protocol/vocabulary/result.hpp"
#include "tests/benchmarks/cost/cost_gates.hpp"

namespace pitwall::benchmarks {

// Scenario of the closed-loop benchmarks.
inline constexpr const char* kBenchScenario = "hil/scenarios/lvms_flying_lap.yaml";

inline constexpr double kLeastTimesRealTime = 50.0;
inline constexpr double kSecondLimit_us = 1e6 / kLeastTimesRealTime;

struct LockstepCost {
  double second_us = 0.0, unit_us = 0.0;

  double times_real_time() const { return 1e6 / second_us; }
  double units() const { return second_us / unit_us; }
};

Result<LockstepCost, Problem> lockstep_cost(const bench::Loaded& loaded, bool with_log);

// The run with the median cost of a second in reference units.
LockstepCost median_of(std::vector<LockstepCost> runs);
cost::CostGate lockstep_gate(const LockstepCost& cost, const std::string& which);

}  // namespace pitwall::benchmarks
