// `pitwall-hil bench plant [--json FILE]`: what the modelled car costs.
//
//   in     hil/scenarios/lvms_flying_lap.yaml for the lockstep part
//   out    microseconds of one step of 1 ms: double track, single track, kinematic; milliseconds
//          per simulated second; times real time of the whole lockstep bench. Peers stand beside
//          with the figures that they publish, marked as such: they are not measured here
//   how    best of many short batches in a banked bend: what the code costs, not what else the
//          machine does; the median is printed too. The lockstep figure is that of the best run
//          likewise, but a run is long: it wants a machine that does nothing else
//   gates  double track <= 5 us a step, lockstep >= 50 times real time: exit code 1 where one is
//          missed
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::verbs {

int bench_plant(std::span<const std::string> args);

}  // namespace pitwall::verbs
