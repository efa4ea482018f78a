// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/clock.hpp"

#include <sys/timex.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>

#include "protocol/transport/bench_clock/bench_clock.hpp"
#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::transport {
namespace {

std::int64_t read_clock(clockid_t which) {
  timespec t{};
  const auto outcome = posix_call([&] { return clock_gettime(which, &t); });
  CHECK(outcome.ok());
  return t.tv_sec * kNanosecondsPerSecond + t.tv_nsec;
}

void sleep_on_wall(Instant deadline) {
  if (deadline.ns <= 0) return;
  const timespec t = to_timespec({deadline.ns});
  const auto outcome =
      posix_call([&] { return clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr); },
                 Success::kZeroElseNumber);
  CHECK(outcome.ok());
}

}  // namespace

Result<bool, Problem> use_clock(const std::string& source) {
  return source == kWallClock ? Result<bool, Problem>{true} : BenchClock::use(source);
}

bool has_bench_time() { return BenchClock::used() != nullptr; }

Result<bool, Problem> take_turns() {
  BenchClock* const bench = BenchClock::used();
  if (bench == nullptr || bench->take_turns()) return true;
  return Unexpected{Problem{"bench time", "too many threads use it already"}};
}

Instant monotonic_now() {
  const BenchClock* const bench = BenchClock::used();
  return bench == nullptr ? wall_now() : bench->now();
}

UtcTime utc_now() {
  const BenchClock* const bench = BenchClock::used();
  const UtcTime calendar{read_clock(CLOCK_REALTIME)};
  if (bench == nullptr) return calendar;
  const Duration stood = wall_now() - bench->now();
  return {calendar.ns - stood.ns};
}

std::optional<BenchPause> bench_pause() {
  const BenchClock* const bench = BenchClock::used();
  if (bench == nullptr) return std::nullopt;
  return bench->pause();
}

Instant to_instant(UtcTime stamp, Duration offset) {
  const BenchClock* const bench = BenchClock::used();
  const Instant wall{stamp.ns - offset.ns};
  return bench == nullptr ? wall : bench->time_of(wall);
}

std::optional<Duration> utc_error() {
  timex state{};
  const auto outcome = posix_call([&] { return ::adjtimex(&state); });
  if (!outcome.ok() || (state.status & STA_UNSYNC) != 0) return std::nullopt;
  const Duration unit = (state.status & STA_NANO) != 0 ? Duration{1} : microseconds(1);
  return std::max(Duration{unit.ns * std::abs(std::int64_t{state.offset})},
                  microseconds(state.esterror));
}

Duration thread_time() { return {read_clock(CLOCK_THREAD_CPUTIME_ID)}; }

void sleep_until(Instant deadline) {
  BenchClock* const bench = BenchClock::used();
  if (bench == nullptr) return sleep_on_wall(deadline);
  bench->sleep_until(deadline);
}

Duration realtime_minus_monotonic() {
  constexpr int kAttempts = 3;  // one of them is hardly ever interrupted
  constexpr Duration kTight = microseconds(2);
  Duration best{};
  Duration tightest{INT64_MAX};
  Instant before = wall_now();
  for (int i = 0; i < kAttempts && tightest > kTight; ++i) {
    const UtcTime utc{read_clock(CLOCK_REALTIME)};
    const Instant after = wall_now();
    const Duration width = after - before;
    if (width < tightest) {
      tightest = width;
      best = {utc.ns - (before.ns + width.ns / 2)};
    }
    before = after;
  }
  return best;
}

Ticker::Ticker(Duration period, Instant start) : period_(period), last_(start) {
  CHECK(period.ns > 0);
}

Tick Ticker::next() {
  const Tick tick = next_tick(last_, period_, monotonic_now());
  sleep_until(tick.deadline);
  last_ = tick.deadline;
  return tick;
}

}  // namespace pitwall::transport
