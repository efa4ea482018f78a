// One lap of a car over the stations of the track: when it was driven, and what was measured where.
//   units  columns by LapColumn; the point i is at the station i * step of the LapLog
//   invariants
//          what was not received is NaN in its column, never a value from before
//          the time is only that of the lap if the start was seen: then it counts from there
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::state {

enum class LapColumn : std::uint8_t {
  kTime,        // s since `begin`
  kSpeed,       // m/s
  kCrossTrack,  // m, left of the line positive
  kThrottle,    // 0 .. 1
  kBrake        // kPa, front
};
inline constexpr std::size_t kLapColumns = 5;
constexpr std::size_t index_of(LapColumn column) { return static_cast<std::size_t>(column); }

struct Lap {
  std::uint32_t id = 0;     // counts up, from 1
  double number = kUnset;   // the newest lap count of race control that came in this lap
  Instant begin{}, end{};   // at the line where that was seen; else the first and the last sample
  bool start_seen = false;  // crossed the line between two samples that are no gap apart
  bool finish_seen = false;
  bool running = true;
  Duration gap{};  // the longest time inside the lap without a station
  std::array<std::vector<float>, kLapColumns> columns{};

  bool complete() const { return start_seen && finish_seen; }
  double time_s() const { return complete() ? (end - begin).seconds() : kUnset; }
  const std::vector<float>& column(LapColumn which) const { return columns[index_of(which)]; }
  std::vector<float>& column(LapColumn which) { return columns[index_of(which)]; }
};

}  // namespace pitwall::state
