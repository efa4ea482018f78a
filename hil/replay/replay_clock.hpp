// Clock of a replay, chosen by --clock: the wall clock, or the bench time of the programs under
// test. With bench time, a machine that stalls one of these programs delays the replay by the same
// time as the car.
//
//   wall clock   0 . . . 10 . . . 20 . . . 30 . . . 40
//   bench time   0 . . . 10 . . . . . . . . . 10 . . 20     the car had no processor from 10 to 30
//   replay       a . b . c  . . . . . . . . . . d . e
//
//   in     "wall", or the clock file of bench time in /dev/shm, the one that the programs were
//          started with. If no other process keeps that clock, the replay keeps it, as a bench does
//   out    bench time as the clock of this program, from open() on. From begin() to end() bench
//          time also waits for the calling thread. How long bench time paused, and for which
//          program
//   errors Problem: the file cannot be opened, another program keeps the clock already, or there is
//          no room for another waiting thread
//   cost   if the replay keeps the clock, one thread that wakes up every millisecond
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
  // Pauses from begin() to this call; `longest_at` counts from begin(). Empty with the wall clock.
  // If another process keeps the clock, only the total is known.
  std::optional<transport::ClockWaits> end();

 private:
  explicit ReplayClock(std::string file) : file_(std::move(file)) {}

  std::string file_;  // empty: the wall clock
  std::optional<transport::KeptClock> kept_;
  Instant begun_{}, wall_begun_{};
};

// Example: "bench time stood 3 times, 0.25 s in all, at the longest 79 ms at 13.67 s for
// pitwall-vehicle".
std::string to_text(const transport::ClockWaits& waits);
std::string to_json(const transport::ClockWaits& waits);

}  // namespace pitwall::replay
