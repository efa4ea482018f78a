// Subcommand `pitwall-benchmarks plant [--json FILE]`: processor time of the vehicle model.
//
//   in     hil/scenarios/lvms_flying_lap.yaml for the lockstep part
//   out    microseconds of one step of 1 ms: double track, single track, kinematic; milliseconds
//          per simulated second; speed of the whole lockstep bench relative to real time. Figures
//          that peers publish are listed and marked as such: they are not measured here
//   how    processor time of many short batches in a banked bend, alternating with the reference
//          unit (tests/benchmarks/cost), so that other load on the machine does not count
//   gates  medians on the reference machine: double track 5 us, lockstep 50 times real time; exit
//          code 1 if one is missed
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int bench_plant(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
