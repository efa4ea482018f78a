// Clock that a replay goes by, as --clock names it: the wall clock, or the bench time of the
// programs that it plays to. A machine that holds one of them up then stretches the replay as it
// stretches the car.
//
//   wall clock   0 . . . 10 . . . 20 . . . 30 . . . 40
//   bench time   0 . . . 10 . . . . . . . . . 10 . . 20     the car had no processor from 10 to 30
//   replay       a . b . c  . . . . . . . . . . d . e
//
//   in     "wall", or the file in which bench time is kept, in /dev/shm: the one that the programs
//          were started with. Where nobody keeps it, the replay does, as a bench would
//   out    bench time as the clock of this program, from open() on; from begin() to end() it waits
//          for the calling thread, too. For how long it stood, and for whom
//   errors Problem: no such file can be opened, another program came first, no room to take turns
//   cost   where the replay keeps the time, a thread that wakes up every millisecond
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "protocol/transport/bench_clock/clock_waits.hpp"
#include "protocol/transport/bench_clock/kept_clock.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::replay {

class ReplayClock {
 public:
  static Result<ReplayClock, Problem> open(const std::string& source);

  bool is_wall() const { return file_.empty(); }
  Result<bool, Problem> begin();
  // From begin() to here; `longest_at` since then. Nothing by the wall clock. Of a time that
  // another keeps only the total is known.
  std::optional<transport::ClockWaits> end();

 private:
  explicit ReplayClock(std::string file) : file_(std::move(file)) {}

  std::string file_;  // empty: the wall clock
  std::optional<transport::KeptClock> kept_;
  Instant begun_{}, wall_begun_{};
};

// "bench time stood 3 times, 0.25 s in all, at the longest 79 ms at 13.67 s for pitwall-vehicle".
std::string to_text(const transport::ClockWaits& waits);
std::string to_json(const transport::ClockWaits& waits);

}  // namespace pitwall::replay
