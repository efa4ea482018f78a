// Live bench: the unmodified car process on real SocketCAN, with the rig in real time on the same
// bus. It runs where the CAN interface exists (in the kernel or in the guest; hil/can_bus decides
// that).
//
//   pitwall-vehicle <== CAN ==> live bench (plant, drive-by-wire, race control)
//    ^   |   ^                   |    |   ^
//    |   |   '-- UDP, radio -----'    |   '--> UDP, the radio's other end: the base station
//    |   '------ local report --------'
//    '---------- UDP NovAtel bytes of two receivers
//
//   in     scenario, Setup of the car, LivePlan
//   out    RunResult with the same verdicts as lockstep; times are real. It and the event log have
//          the actions of the scenario on processes, clock and disk
//   errors Problem: no interface; a process did not start, or ended without being killed. A late
//          wake-up is made up for and counted; a log or a summary that cannot be written is
//          reported, and the run goes on
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hil/bench/field.hpp"
#include "hil/bench/live/live_plan.hpp"
#include "hil/bench/loading.hpp"
#include "hil/bench/result.hpp"
#include "hil/scenario/scenario.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/pipeline/setup.hpp"

namespace pitwall::bench {

struct LiveResult {
  RunResult run;
  RadioCounters radio;
  std::uint64_t reports = 0;  // local reports of the car that were received
};

// A car with a full stack of its own, in its own bay (live_plan.hpp). The first plan has the clock.
struct LiveStack {
  const scenario::Scenario& scenario;
  const pipeline::Setup& setup;
  const LivePlan& plan;
  std::string name = "own";  // for messages

  Runner runner() const { return {scenario, setup, name}; }
};

// Result of each car, in their order. At least one car. A run ends for all when it ends for one of
// them, and at a contact of two.
Result<std::vector<LiveResult>, Problem> run_live(std::span<const LiveStack> cars,
                                                  std::span<const FieldGhost> ghosts = {});

// Of a scenario with the other cars that it names: a plan for ours, then for each with a stack.
Result<std::vector<LiveResult>, Problem> run_live(const Loaded& loaded,
                                                  std::span<const LivePlan> plans);

}  // namespace pitwall::bench
