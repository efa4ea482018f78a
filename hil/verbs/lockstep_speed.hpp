// How much faster than real time the lockstep bench runs a scenario on this machine.
//   in     a loaded scenario; whether the event log is written as well (to nowhere)
//   out    scenario time over the processor time of the one thread that runs it: on an idle machine
//          the same as wall time, on another one still its speed
//   errors Problem of the run
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/bench/loading.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::verbs {

// What the benchmarks of the closed loop drive.
inline constexpr const char* kBenchScenario = "hil/scenarios/lvms_flying_lap.yaml";

Result<double, Problem> times_real_time(const bench::Loaded& loaded, bool with_log);

}  // namespace pitwall::verbs
