// The live bench: the unmodified car process on real SocketCAN, the rig in real time on the same
// bus.
// Runs where the CAN interface exists (the kernel's, or the guest's; hil/can_bus decides that).
//
//   pitwall-vehicle <== CAN ==> live bench (plant, drive-by-wire, race control)
//    ^   |   ^                   |    |   ^
//    |   |   '-- UDP, radio -----'    |   '--> UDP, the radio's other end: the base station
//    |   '------ local report --------'
//    '---------- UDP NovAtel bytes of two receivers
//
//   in     scenario, Setup of the car, LivePlan
//   out    RunResult with the same verdicts as lockstep; times are real. What the scenario did to
//          processes, clock and disk is in it and in the event log
//   errors Problem: no interface; a process did not start, or ended although nobody killed it. A
//          late wake-up is caught up and counted; a log or a summary that could not be written is
//          told, and the run goes on
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "hil/bench/live/live_plan.hpp"
#include "hil/bench/result.hpp"
#include "hil/scenario/scenario.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/pipeline/setup.hpp"

namespace pitwall::bench {

struct LiveResult {
  RunResult run;
  RadioCounters radio;
  std::uint64_t reports = 0;  // of the car, heard on this machine
};

Result<LiveResult, Problem> run_live(const scenario::Scenario& scenario,
                                     const pipeline::Setup& setup, const LivePlan& plan);

}  // namespace pitwall::bench
