// What a recorded run says of the world that its car was in, as a scenario has it.
//   in     a RecordedRun from its first tick, the Setup of its car
//   out    start, flags and operator by time, modes, the highest speed, the farthest from the line
//   units  SI; times since the first frame that the car heard, where a bench begins
//   invariants
//          the run ends with the tick of the last frame: a bus that nobody serves any more is no
//          part of the world that is told here
//          flags are those that the car had understood, when it had: race control showed them a
//          period of its frames earlier at most
//   errors those of RecordedRun; a car that heard no frame, or never knew where it was
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hil/bench/recorded/command_trace.hpp"
#include "hil/scenario/scenario.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/pipeline/setup.hpp"

namespace pitwall::bench {

// By the first position that the car knew; brought back to the beginning at its speed.
struct RecordedStart {
  Duration known_at{};
  double s_m = 0.0, n_m = 0.0, speed_mps = 0.0;
};

struct RunFacts {
  Duration first_frame{};  // from the first tick
  Duration length{};       // from the first frame to the tick of the last one
  RecordedStart start;
  double tyres_c = kUnset;  // mean of the four, when all were first known
  std::vector<scenario::FlagChange> flags;
  std::vector<scenario::OperatorText> operator_texts;
  std::vector<CommandSample> modes;  // changes after the first frame, and the mode before
  double speed_max_mps = 0.0, off_line_max_m = 0.0;
  std::uint64_t joystick_ticks = 0, guardian_ticks = 0;
};

Result<RunFacts, Problem> facts_of(RecordedRun& run, const pipeline::Setup& setup);

}  // namespace pitwall::bench
