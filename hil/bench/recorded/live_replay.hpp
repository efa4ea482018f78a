// Live replay of a recorded run: the process of the unmodified car is started, receives the
// recorded frames and receiver bytes at the recorded times, and records its own run.
//
//   recording   tick 0 -------- frame, bytes ... -------- last tick
//   live        first frame of the car: tick 0 here too, and from there on the recording's times
//
//   in     the recording of one run, its trace, the plan of a live run: programs, ports, clock
//   out    the car's own recording in the folder of the plan; a report of the replay
//   invariants
//          the base station of the plan, if any, gets the operator's commands and stops, each one
//          packet slot before the recorded car received it; joystick samples and radio gaps are not
//          replayed
//          the car starts armed if the recorded one did. Nothing is sent before the first frame of
//          the car has arrived, or after the end of the recorded run
//          bench time pauses while the machine delays car or player
//   errors Problem: no bus; a car that does not start, sends nothing or ends; a recording without
//          frames and bytes to replay
//   cost   the length of the run, in bench time
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "hil/bench/live/live_plan.hpp"
#include "hil/bench/recorded/command_trace.hpp"
#include "hil/replay/player.hpp"
#include "hil/replay/recordings/recording.hpp"
#include "protocol/transport/bench_clock/clock_waits.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::bench {

struct PlayedRun {
  replay::PlayReport report;
  std::optional<transport::ClockWaits> waits;  // nullopt: by the wall clock
};

Result<PlayedRun, Problem> play_to_car(traffic::Recording recording, const CommandTrace& recorded,
                                       const LivePlan& plan);

}  // namespace pitwall::bench
