// Clocks of the program: the only place that reads the time. All other code gets it as an argument.
//   in     the clock that this program uses: the wall clock, or bench time (bench_clock/)
//   out    Instant, UtcTime, processor time of a thread, sleeps to absolute deadlines
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
// Sets the clock: "wall", which is the default, or the file with the bench time. To be called
// before any other thread starts.
Result<bool, Problem> use_clock(const std::string& source);
bool has_bench_time();
// Bench time then stands while the calling thread is due and gets no processor. No effect by the
// wall clock.
Result<bool, Problem> take_turns();

// Time by the clock in use; the wall clock itself is wall_now(), CLOCK_MONOTONIC.
Instant monotonic_now();
// CLOCK_REALTIME; under a bench, minus the time for which bench time stood.
UtcTime utc_now();
// Error of the calendar clock as the time service reports it: the larger of the correction under
// way and of its own estimate. Empty if the clock is not synchronised.
std::optional<Duration> utc_error();
// Lag of bench time behind the wall clock since this program uses it; empty by the wall clock.
std::optional<BenchPause> bench_pause();
// Processor time of this thread: the cost of its work, independent of other load.
Duration thread_time();

// Returns at or after the deadline; at once if it has passed. Signals never make it return earlier.
void sleep_until(Instant deadline);

// CLOCK_REALTIME minus CLOCK_MONOTONIC, read between two monotonic readings; the attempt with the
// smallest interval is kept.
Duration realtime_minus_monotonic();
// Time of a kernel stamp (CLOCK_REALTIME) by the clock in use.
Instant to_instant(UtcTime stamp, Duration offset);

// Interval in which a message can have arrived: after the socket was last found empty, and before
// the read. A kernel stamp outside of it means that the calendar clock has been stepped since.
struct ArrivalWindow {
  static constexpr Duration kSlack = milliseconds(20);  // from stamp to queue, from clock to read
  Instant empty_at{};                                   // unset: never found empty
  Instant now{};                                        // start of the read

  constexpr bool holds(Instant at) const { return at >= empty_at - kSlack && at <= now + kSlack; }
};

struct Tick {
  Instant deadline;          // the deadline due now: first + k * period, so there is no drift
  std::uint64_t missed = 0;  // earlier deadlines that passed without a tick
};

// Arithmetic of Ticker: the deadline after `last` that a caller at `now` should serve. Before the
// next deadline it is the next one (the caller sleeps); after it, the newest one that has passed.
constexpr Tick next_tick(Instant last, Duration period, Instant now) {
  const Instant next = last + period;
  if (now < next + period) return {.deadline = next, .missed = 0};
  const std::int64_t late = (now - next) / period;
  return {.deadline = next + late * period, .missed = static_cast<std::uint64_t>(late)};
}

// Timer of fixed rate without drift: next() sleeps to the next multiple of the period.
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
