// `pitwall-benchmarks plant [--json FILE]`: what the modelled car costs.
//
//   in     hil/scenarios/lvms_flying_lap.yaml for the lockstep part
//   out    microseconds of one step of 1 ms: double track, single track, kinematic; milliseconds
//          per simulated second; times real time of the whole lockstep bench. Peers stand beside
//          with the figures that they publish, marked as such: they are not measured here
//   how    processor time of many short batches in a banked bend, the reference unit in turns with
//          them (tests/benchmarks/cost): what the code costs, not what else the machine does
//   gates  medians, on the reference machine: double track 5 us, lockstep 50 times real
//          time: exit code 1 where one is missed
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int bench_plant(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
