// What the lockstep bench costs on this machine: processor time of the one thread that runs it.
//   in     a loaded scenario; whether the event log is written as well (to nowhere)
//   out    processor time of a simulated second, and of the reference unit, taken twice in each of
//          them and not part of it
//   errors Problem of the run
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "hil/bench/loading.hpp"
#include "protocol/vocabulary/result.hpp"
#include "tests/benchmarks/cost/cost_gates.hpp"

namespace pitwall::benchmarks {

// What the benchmarks of the closed loop drive.
inline constexpr const char* kBenchScenario = "hil/scenarios/lvms_flying_lap.yaml";

inline constexpr double kLeastTimesRealTime = 50.0;
inline constexpr double kSecondLimit_us = 1e6 / kLeastTimesRealTime;

struct LockstepCost {
  double second_us = 0.0, unit_us = 0.0;

  double times_real_time() const { return 1e6 / second_us; }
  double units() const { return second_us / unit_us; }
};

Result<LockstepCost, Problem> lockstep_cost(const bench::Loaded& loaded, bool with_log);

// Of several runs, by what a second of them costs in units: the one in the middle.
LockstepCost median_of(std::vector<LockstepCost> runs);
cost::CostGate lockstep_gate(const LockstepCost& cost, const std::string& which);

}  // namespace pitwall::benchmarks
