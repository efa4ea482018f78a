// Bench time for the threads of one program: what time it is, and waiting for a deadline.
//   in     the page that a bench keeps; deadlines in bench time
//   out    naps of the wall clock until bench time has reached the deadline
//   invariants
//          a thread that takes turns has the bench wait for it: from its deadline on until it has
//          done its work and waits again. Other threads are told the time and hold up nobody.
//          Where the bench died, time goes on by the wall clock after a tenth of a second
//   cost   no memory, no lock, no system call beside the wait itself
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <string>

#include "protocol/transport/bench_clock/bench_pause.hpp"
#include "protocol/transport/bench_clock/clock_memory.hpp"

namespace pitwall::transport {

class BenchClock {
 public:
  static Result<bool, Problem> use(const std::string& path);  // once, before other threads start
  static BenchClock* used();                                  // none: this program has the wall's
  explicit BenchClock(ClockMemory memory);

  Instant now() const;
  // Of this program: what bench time stood before it came does not count. The total never shrinks.
  BenchPause pause() const;
  Instant time_of(Instant wall) const { return bench_time_of(memory_.page(), wall); }
  // The calling thread takes turns from its next wait on. False: no slot is free.
  bool take_turns();
  // `nap(how long)` waits on the wall clock and says whether something else ended it.
  template <class Nap>
  void wait_until(Instant deadline, Nap&& nap);

 private:
  static constexpr Duration kNap = microseconds(100), kLongestNap = milliseconds(2);
  static constexpr Duration kLook = milliseconds(100);  // at whether the bench lives

  // While it lives the calling thread waits for its turn.
  class Wait {
   public:
    explicit Wait(Instant due);
    ~Wait();
    Wait(const Wait&) = delete;
    Wait& operator=(const Wait&) = delete;
  };

  Duration stands() const;
  void look_after_bench();

  ClockMemory memory_;
  std::int64_t behind_at_start_ns_ = 0;
  mutable std::atomic<std::int64_t> stood_ns_{0};  // the most that was seen
};

template <class Nap>
void BenchClock::wait_until(Instant deadline, Nap&& nap) {
  Instant at = now();
  const Wait wait{std::max(deadline, at)};
  Duration next_nap = kNap, next_look = kLook;
  while (true) {
    const Duration left = deadline - at;
    const Duration span = left.ns <= 0 ? Duration{} : std::max(left, next_nap);
    if (nap(span) || left.ns <= 0) return;
    at = now();
    if (at >= deadline) return;
    next_nap = std::min(next_nap + next_nap, kLongestNap);
    const Duration stood = stands();
    if (stood < next_look) continue;
    look_after_bench();
    next_look = stood + kLook;
  }
}

}  // namespace pitwall::transport
