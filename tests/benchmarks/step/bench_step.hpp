// Benchmarks of the closed loop: processor time of a step of the car and of a second of lockstep.
//   step       gates: p50 100 us, p99 1.2 ms on the reference machine (planning, late measurements)
//   lockstep   gate: a second costs at most what 50 times real time is on that machine
//   out    a table; exit code 1 when a gate is missed, 2 for a wrong option
//   how    processor time in reference units of the same run, see tests/benchmarks/cost:
//          a busy neighbour or a slower machine moves the figures and not the verdict
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int bench_step(std::span<const std::string> args);
int bench_lockstep(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
