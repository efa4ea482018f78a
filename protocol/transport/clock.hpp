// The only place that knows what time it is. Everybody else is told.
//   in     the clock that this program goes by: the wall clock, or that of a bench (bench_clock/)
//   out    Instant, UtcTime, time spent by a thread, sleeps to absolute deadlines
//   units  int64 nanoseconds
//   errors use_clock(): Problem with the file of bench time. A clock that fails later is our own
//          mistake (CHECK)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "protocol/transport/bench_clock/bench_pause.hpp"
#include "protocol/transport/bench_clock/wall_clock.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::transport {

inline constexpr const char* kWallClock = "wall";
// "wall", which is also what a program goes by that says nothing, or the file in which a bench
// keeps its time. Before any other thread starts.
Result<bool, Problem> use_clock(const std::string& source);
bool has_bench_time();
// A bench lets time stand while the calling thread is held up; nothing by the wall clock.
Result<bool, Problem> take_turns();

// By the clock in use; what only the wall clock can tell is wall_now(), CLOCK_MONOTONIC.
Instant monotonic_now();
// CLOCK_REALTIME; under a bench less the time for which the bench stood.
UtcTime utc_now();
// How far the calendar may be off, by the service that keeps it: the larger of what it still
// corrects and of its own estimate. None: nothing compares this clock with another.
std::optional<Duration> utc_error();
// How bench time is behind the wall clock since this program goes by it; none by the wall clock.
std::optional<BenchPause> bench_pause();
// What this thread has had of a processor: what its work costs, whoever else wants the machine.
Duration thread_time();

// Returns at or after the deadline; at once if it has passed. Never earlier, whatever signals come.
void sleep_until(Instant deadline);
// By the wall clock: for who keeps bench time, and would wait for itself.
void nap(Duration span);

// CLOCK_REALTIME less CLOCK_MONOTONIC. Taken between two monotonic readings; the tightest of a few
// attempts is kept.
Duration realtime_minus_monotonic();
// When a kernel stamp (CLOCK_REALTIME) was made, by the clock in use.
Instant to_instant(UtcTime stamp, Duration offset);

// When something that was read can have arrived: after the socket was last found empty, and before
// it was read. A kernel stamp outside of that belongs to a calendar that has been stepped since.
struct ArrivalWindow {
  static constexpr Duration kSlack = milliseconds(20);  // from stamp to queue, from clock to read
  Instant empty_at{};                                   // unset: never found empty
  Instant now{};                                        // when the reading began

  constexpr bool holds(Instant at) const { return at >= empty_at - kSlack && at <= now + kSlack; }
};

struct Tick {
  Instant deadline;          // the one that is due now; always first + k * period, so no drift
  std::uint64_t missed = 0;  // earlier deadlines that passed unserved
};

// The arithmetic of Ticker: the newest deadline after `last` that a caller at `now` should serve.
// Before the next deadline that is the next one (to be slept for); after it, the newest one passed.
constexpr Tick next_tick(Instant last, Duration period, Instant now) {
  const Instant next = last + period;
  if (now < next + period) return {.deadline = next, .missed = 0};
  const std::int64_t late = (now - next) / period;
  return {.deadline = next + late * period, .missed = static_cast<std::uint64_t>(late)};
}

// A fixed rate without drift: next() sleeps to the next multiple of the period.
class Ticker {
 public:
  explicit Ticker(Duration period) : Ticker(period, monotonic_now()) {}
  Ticker(Duration period, Instant start);  // the first deadline is start + period
  Tick next();

 private:
  Duration period_;
  Instant last_;
};

}  // namespace pitwall::transport
