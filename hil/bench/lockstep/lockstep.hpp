// Lockstep bench: one car or several on one track, each with its computer, bus and rig, in one
// process and one thread, in virtual time. The same scenarios, build and seeds give the same bytes
// of event logs.
//
//   t      cars: read what the bus delivered by t, step, offer frames
//   t+1ms  rigs: one plant step, offer frames; buses advance       (ten times per tick)
//   t+10ms cars: ...
// The guardian of a car, if present, is stepped every 5 ms, before the car.
//
//   in     for each car its scenario, Setup and options (with a sink for the event log, which may
//          discard everything)
//   out    RunResult of each; the caller measures the wall time
//   invariants
//          the cars share the track and race control's flags. A run ends for all when it ends for
//          one of them, and at a contact of two
//   errors Problem of a scenario or of an unknown signal; cars on different tracks, with different
//          flags, durations or ticks; nothing else stops a run
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "hil/bench/field.hpp"
#include "hil/bench/loading.hpp"
#include "hil/bench/lockstep/guardian_node.hpp"
#include "hil/bench/progress.hpp"
#include "hil/bench/result.hpp"
#include "hil/bench/rig.hpp"
#include "hil/scenario/scenario.hpp"
#include "protocol/recording/mcap_writer.hpp"
#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/pipeline/step.hpp"

namespace pitwall::bench {

using StepFunction = std::function<pipeline::Outputs(const pipeline::Setup&, pipeline::Car&,
                                                     const pipeline::Inputs&)>;

struct LockstepOptions {
  recording::Sink log = {};            // empty: no event log, no digest
  StepFunction step = pipeline::step;  // the car; a benchmark or a test may wrap it to measure it
  // Called after every tick of the car, e.g. by a test. While the car process is stopped or dead,
  // it is called with the last outputs.
  std::function<void(const pipeline::Outputs&, const Rig&, Instant)> watch = {};
  Follow follow = {};  // called after every tick of the car, after grading
  // Called after that, before the rig advances: for faults at a time that depends on the run.
  std::function<void(Rig&, Instant)> break_rig = {};
  // Called at the end of every tick; true ends the run there, as if it had been that short.
  std::function<bool(const RunView&)> over = {};
  // Called with each telemetry snapshot that the car sends to the pit wall.
  std::function<void(const telemetry::Snapshot&, Instant)> watch_telemetry = {};
  // The guardian takes part if the scenario stops or kills a process; true: always.
  bool guardian = false;
  // Called before every tick of the car; true: the car process counts as killed by a fault.
  std::function<bool()> car_is_dead = {};
  // Called after every tick of the guardian.
  std::function<void(const GuardianNode&, Instant)> watch_guardian = {};
};

// A car with a full stack of its own.
struct Stack {
  const scenario::Scenario& scenario;
  const pipeline::Setup& setup;
  LockstepOptions options = {};
  std::string name = "own";  // for messages

  Runner runner() const { return {scenario, setup, name}; }
};

// Result of each car with a stack, in their order. At least one.
Result<std::vector<RunResult>, Problem> run_lockstep(std::span<const Stack> cars,
                                                     std::span<const FieldGhost> ghosts = {});

// Of a scenario with the other cars that it names. `other_logs`: for the event log of each other
// car with a stack, or none.
Result<RunResult, Problem> run_lockstep(const Loaded& loaded, const LockstepOptions& options,
                                        std::span<const recording::Sink> other_logs = {});

// Of one car that is alone: a scenario that names others is refused.
Result<RunResult, Problem> run_lockstep(const scenario::Scenario& scenario,
                                        const pipeline::Setup& setup,
                                        const LockstepOptions& options);

}  // namespace pitwall::bench
