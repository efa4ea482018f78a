// Facts about the environment of a recorded run, in the terms of a scenario.
//   in     a RecordedRun from its first tick, the Setup of its car
//   out    start, flags and operator texts by time, modes, highest speed, largest distance from the
//          line
//   units  SI; times since the first frame that the car received, where a bench run begins
//   invariants
//          the run ends with the tick of the last received frame: the silent bus after it is not
//          part of the scenario
//          flags are those that the car had decoded, at the time of decoding; race control sent
//          them at most one period of its frames earlier
//   errors those of RecordedRun; Problem for a car that received no frame or never had a position
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

// Start of the run: the first known position, moved back along the track to time zero at the speed
// of the car.
struct RecordedStart {
  Duration known_at{};
  double s_m = 0.0, n_m = 0.0, speed_mps = 0.0;
};

struct RunFacts {
  Duration first_frame{};  // from the first tick
  Duration length{};       // from the first frame to the tick of the last one
  RecordedStart start;
  double tyres_c = kUnset;  // mean of the four tyres when all were first known
  std::vector<scenario::FlagChange> flags;
  std::vector<scenario::OperatorText> operator_texts;
  std::vector<CommandSample> modes;  // the mode before the first frame, then each change
  double speed_max_mps = 0.0, off_line_max_m = 0.0;
  std::uint64_t joystick_ticks = 0, guardian_ticks = 0;
};

Result<RunFacts, Problem> facts_of(RecordedRun& run, const pipeline::Setup& setup);

}  // namespace pitwall::bench
