// Subcommand `pitwall-benchmarks ekf [--json FILE]`: processor time of the localization filter.
//
//   in     lockstep runs of LVMS from real receiver bytes. Two time the filter: the spatial and the
//          planar one, each with the longest window, sampled four times a second. Three time each
//          step of the car as it is, with one receiver late by 100 ms; they are equal to the bit,
//          so the least time of a tick is the cost of the step without disturbance by the machine
//   out    a table in microseconds of processor time: a prediction; an update by kind of
//          measurement; a position that arrives 100 ms and 1 s late, with all that is computed
//          again; a step of the car in the ticks that take a late measurement; heap allocations of
//          the steps
//   gates  in reference units of the same run, see tests/benchmarks/cost. On the reference machine,
//          in us, for the spatial filter: prediction 15 and update 30 at p50, each kind; a rewind
//          of 100 ms 1000 and of 1 s 8000 at p50; step with a rewind of 100 ms 1200 at p99, no
//          allocation. Exit code 1 if one is missed
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int bench_ekf(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
