// Subcommands `pitwall-benchmarks step` and `lockstep`: processor time of a step of the car and of
// a second of lockstep.
//   step       gates: p50 100 us, p99 1.2 ms on the reference machine (planning, late measurements)
//   lockstep   gate: a second costs at most 20 ms of that machine (50 times real time)
//   out    a table; exit code 1 if a gate is missed, 2 for a wrong option
//   how    processor time in reference units of the same run, see tests/benchmarks/cost:
//          other load or a slower machine changes the figures but not the verdict
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int bench_step(std::span<const std::string> args);
int bench_lockstep(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
