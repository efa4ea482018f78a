// Bench clock of one program: reads bench time and waits for a deadline in bench time.
//   in     the clock page of the bench; deadlines in bench time
//   out    time; waits until bench time reaches the deadline: in short steps of the wall clock, or
//          asleep until the bench wakes the thread
//   invariants
//          the bench waits for a thread that takes turns: from its deadline until it has done its
//          work and waits again. Other threads only read the time and never stop it
//          after the end of a killed bench, time follows the wall clock again within 0.1 s
//   cost   no memory, no lock, no system call except the wait itself
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <string>

#include "protocol/transport/bench_clock/bench_pause.hpp"
#include "protocol/transport/bench_clock/clock_memory.hpp"
#include "protocol/transport/bench_clock/wall_clock.hpp"

namespace pitwall::transport {

class BenchClock {
 public:
  static Result<bool, Problem> use(const std::string& path);  // once, before other threads start
  static BenchClock* used();  // nullptr: this program uses the wall clock
  explicit BenchClock(ClockMemory memory);

  Instant now() const;
  // Pauses since this program started; pauses before do not count. The total never decreases.
  BenchPause pause() const;
  Instant time_of(Instant wall) const { return bench_time_of(memory_.page(), wall); }
  // From its next wait on, the bench waits for the calling thread. False: no slot is free.
  bool take_turns();
  // `nap(span)` waits by the wall clock; it returns true if another event ended the wait.
  template <class Nap>
  void wait_until(Instant deadline, Nap&& nap);
  // A thread that takes turns is woken by the bench, however long time stands; others nap.
  void sleep_until(Instant deadline);

 private:
  static constexpr Duration kNap = microseconds(100), kLongestNap = milliseconds(2);
  static constexpr Duration kCheckPeriod =
      milliseconds(100);  // period of the check for a dead bench

  // Scope in which the calling thread waits for its turn.
  class Wait {
   public:
    explicit Wait(Instant due);
    ~Wait();
    Wait(const Wait&) = delete;
    Wait& operator=(const Wait&) = delete;
  };

  void sleep_on_bench(Instant deadline);
  void check_bench();

  ClockMemory memory_;
  std::int64_t behind_at_start_ns_ = 0;
  mutable std::atomic<std::int64_t> stood_ns_{0};  // maximum so far
};

template <class Nap>
void BenchClock::wait_until(Instant deadline, Nap&& nap) {
  Instant at = now();
  const Wait wait{std::max(deadline, at)};
  Duration next_nap = kNap, next_check = kCheckPeriod;
  while (true) {
    const Duration left = deadline - at;
    const Duration span = left.ns <= 0 ? Duration{} : std::max(left, next_nap);
    if (nap(span) || left.ns <= 0) return;
    const ClockReading seen = read_clock(memory_.page(), wall_now);
    at = seen.now;
    if (at >= deadline) return;
    next_nap = std::min(next_nap + next_nap, kLongestNap);
    if (seen.pause.now < next_check) continue;
    check_bench();
    next_check = seen.pause.now + kCheckPeriod;
  }
}

}  // namespace pitwall::transport
