// A recorded run played to the unmodified car: its process is started, hears the frames and the
// receivers' bytes of the recording at the times of its own ticks, and records what it does.
//
//   recording   tick 0 -------- frame, bytes ... -------- last tick
//   live        first frame of the car: tick 0 here too, and from there on the recording's times
//
//   in     the recording of one run, its trace, the plan of a live run: programs, ports, clock
//   out    the car's own recording in the folder of the plan; how the playing went
//   invariants
//          a base station of the plan's is told the operator's commands and stops, each a packet's
//          slot before the car had it; the joystick and the gaps of the radio are not played
//          the car is armed at its start where the recorded one was. Nothing is played that came
//          before its first frame was heard, and nothing beyond the recorded run
//          bench time stands while the machine holds car or player up
//   errors Problem: no bus, a car that does not start, says nothing or ends; a recording without
//          frames and bytes to play
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
  std::optional<transport::ClockWaits> waits;  // none: by the wall clock
};

Result<PlayedRun, Problem> play_to_car(traffic::Recording recording, const CommandTrace& recorded,
                                       const LivePlan& plan);

}  // namespace pitwall::bench
