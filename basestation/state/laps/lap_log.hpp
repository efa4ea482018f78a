// Laps of one car, each over the stations of the track, so that laps are compared place by place.
//   in     samples of a group as they arrive, each once, in the order of their time
//   out    laps, oldest first; the fastest complete one
//   invariants
//          a lap begins where the car crosses the line, which lies between two samples; its time is
//          linear between them
//          a point has the time at which the car was there first in this lap. A stretch over which
//          no station came is a gap in every column
//          a lap whose start or finish lies in a gap is not complete and has no time
//          one that is not complete is left out if it is shorter than kLeast_m
//   bound  kMostLaps of kMostPoints: 8 MB. The oldest is dropped first, the fastest never
//   cost   a sample: some points of five columns; nothing is allocated but at the start of a lap
//   units  Instants on the clock of the base
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>

#include "basestation/state/laps/lap.hpp"
#include "basestation/state/laps/lap_progress.hpp"
#include "basestation/state/laps/recent_samples.hpp"
#include "protocol/telemetry/registry/registry.hpp"

namespace pitwall::state {

class LapLog {
 public:
  static constexpr std::size_t kMostLaps = 400, kMostPoints = 1'000;
  static constexpr double kStep_m = 5.0;  // longer on a track of more than kMostPoints of it
  static constexpr double kLeast_m = 100.0;

  explicit LapLog(double length_m);

  void note(const telemetry::Snapshot& state, telemetry::GroupSet groups);

  const std::deque<Lap>& laps() const { return laps_; }
  const Lap* find(std::uint32_t id) const;  // nullptr: dropped, or never there
  const Lap* best() const;                  // nullptr: none is complete
  double length_m() const { return length_m_; }
  double step_m() const { return step_m_; }
  std::size_t points() const { return points_; }
  // Changes when a lap begins, ends or gets its count.
  std::uint64_t revision() const { return revision_; }

 private:
  // How far a column is filled.
  struct Cursor {
    std::uint32_t lap = 0;
    std::size_t point = 0;
  };

  void count_lap(double number);
  void follow(const LapMove& move);
  void begin_lap(Instant at, double way_m, bool seen);
  void end_lap(Instant at, bool seen);
  void cross_line(const LapMove& move);
  void fill_time(const LapMove& move);
  void settle(LapColumn column);

  double length_m_, step_m_;
  std::size_t points_;
  LapProgress progress_;
  std::array<RecentSamples, kLapColumns> samples_;  // of all columns but the time
  std::array<Cursor, kLapColumns> cursors_;
  std::deque<Lap> laps_;
  double from_m_ = kUnset;      // where the running lap begins
  double furthest_m_ = kUnset;  // of the running lap
  std::size_t decided_ = 0;     // points of the running lap that have their time, or never will
  std::uint32_t next_id_ = 1;
  std::uint64_t revision_ = 0;
};

}  // namespace pitwall::state
