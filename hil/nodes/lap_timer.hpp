// Lap timer: laps from the station of a car on the closed track.
//   in     station [m] at each tick, speed, whether the track is green; ticks in order of time
//   out    a Lap at the tick in which the car crosses the start line forwards
//   invariants
//          the times of consecutive laps add up to the time between the first and the last
//          crossing; rolling back over the line and forward again is not a lap
//   units  m, s; the crossing instant is interpolated between two ticks
//   errors a NaN station is skipped; it does not end the lap, but the lap is no longer a flying one
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::race {

struct LapTimerParams {
  double track_length_m = kUnset;
  double start_line_m = 0.0;       // station of the start line
  double flying_speed_mps = 10.0;  // minimum speed at the line for a flying lap
};

struct LapTick {
  double station_m = kUnset, speed_mps = kUnset;
  bool green = false;  // green or waving green
};

struct Lap {
  std::uint32_t number = 0;  // 1 is the first lap from line to line
  Instant begin{}, end{};
  double mean_speed_mps = kUnset;
  bool flying = false;  // started and ended at speed, under green from line to line
};

struct LapTimerState {
  bool begun = false, timing = false;
  double position_m = 0.0;  // distance after the line, 0 .. track length
  // since the last crossing of the line; negative after rolling back over it
  double driven_m = 0.0;
  Instant last{}, lap_begin{};
  std::uint32_t laps = 0;
  bool flying = false;
};

std::optional<Lap> step(const LapTimerParams& params, LapTimerState& state, const LapTick& tick,
                        Instant now);

}  // namespace pitwall::race
