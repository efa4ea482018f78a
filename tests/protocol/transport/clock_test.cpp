// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/clock.hpp"

#include <gtest/gtest.h>
#include <sys/timex.h>

namespace pitwall::transport {
namespace {

TEST(Clock, MonotonicTimeNeverGoesBack) {
  Instant last = monotonic_now();
  for (int i = 0; i < 10'000; ++i) {
    const Instant now = monotonic_now();
    ASSERT_GE(now, last);
    last = now;
  }
}

TEST(Clock, AThreadThatSleepsSpendsNothing) {
  const Duration before = thread_time();
  const Instant from = monotonic_now();
  sleep_until(from + milliseconds(200));
  EXPECT_LT(thread_time() - before, milliseconds(100));
  while (thread_time() - before < milliseconds(120)) continue;
  EXPECT_GE(monotonic_now() - from, milliseconds(200));
}

TEST(Clock, SleepNeverEndsEarlyAndThePastIsNoWait) {
  for (int i = 1; i <= 20; ++i) {
    const Instant deadline = monotonic_now() + microseconds(137 * i);
    sleep_until(deadline);
    EXPECT_GE(monotonic_now(), deadline);
  }
  sleep_until(Instant{-5});
  sleep_until(Instant{});
  sleep_until(monotonic_now() - seconds(1));
}

TEST(Clock, OffsetTakesCalendarStampsToTheMonotonicClock) {
  const Instant before = monotonic_now();
  const UtcTime stamp = utc_now();
  const Instant after = monotonic_now();
  const Instant converted = to_instant(stamp, realtime_minus_monotonic());
  EXPECT_GE(converted, before - milliseconds(50));
  EXPECT_LE(converted, after + milliseconds(50));
}

// The laws of a fixed rate, for every lateness: deadlines are multiples of the period, none is
// served twice, and served plus missed deadlines are all deadlines.
TEST(Ticker, DeadlinesAreMultiplesAndAllAreAccountedFor) {
  const Duration period = milliseconds(10);
  std::uint64_t seed = 1;
  Instant last{};
  Instant now{};
  std::uint64_t served = 0, missed = 0;
  for (int i = 0; i < 5'000; ++i) {
    seed = seed * 6364136223846793005U + 1442695040888963407U;
    now += nanoseconds(static_cast<std::int64_t>((seed >> 33U) % 35'000'000));
    const Tick tick = next_tick(last, period, now);
    ASSERT_EQ(tick.deadline.ns % period.ns, 0);
    ASSERT_GT(tick.deadline, last);
    ASSERT_LT(now, tick.deadline + period);  // the newest one
    ++served;
    missed += tick.missed;
    last = tick.deadline;
    now = std::max(now, tick.deadline);
    ASSERT_EQ(static_cast<std::int64_t>(served + missed), last.ns / period.ns);
  }
  EXPECT_GT(missed, 0U);
}

TEST(ArrivalWindow, HoldsWhatCameSinceTheSocketWasEmptyAndNothingOfAnotherCalendar) {
  const ArrivalWindow window{.empty_at = {seconds(100).ns}, .now = {seconds(101).ns}};
  for (const std::int64_t step_ms : {-3'600'000, -1'021, -121, 121, 1'021, 3'600'000}) {
    const Instant beyond = (step_ms < 0 ? window.empty_at : window.now) + milliseconds(step_ms);
    EXPECT_FALSE(window.holds(beyond)) << step_ms;
  }
  for (std::int64_t ms = -20; ms <= 1'020; ++ms)
    EXPECT_TRUE(window.holds(window.empty_at + milliseconds(ms))) << ms;
  EXPECT_FALSE(window.holds(window.empty_at - milliseconds(21)));
  EXPECT_FALSE(window.holds(window.now + milliseconds(21)));
}

TEST(Ticker, AnOnTimeCallerMissesNothing) {
  Instant last{};
  for (int i = 0; i < 100; ++i) {
    const Tick tick = next_tick(last, milliseconds(10), last + milliseconds(9));
    EXPECT_EQ(tick.missed, 0U);
    EXPECT_EQ(tick.deadline, last + milliseconds(10));
    last = tick.deadline;
  }
}

TEST(Ticker, NextReturnsAtItsDeadline) {
  const Instant start = monotonic_now();
  Ticker ticker(milliseconds(1), start);
  for (int i = 0; i < 20; ++i) {
    const Tick tick = ticker.next();
    EXPECT_GE(monotonic_now(), tick.deadline);
    EXPECT_EQ((tick.deadline - start).ns % 1'000'000, 0);
  }
}

// A machine that nobody keeps in time says so; one that is kept is off by less than a second.
TEST(Clock, TheCalendarsErrorIsSmallOrUnknown) {
  timex kernel{};
  const bool is_kept = ::adjtimex(&kernel) >= 0 && (kernel.status & STA_UNSYNC) == 0;
  const auto error = utc_error();
  ASSERT_EQ(error.has_value(), is_kept);
  if (!error) return;
  EXPECT_GE(*error, Duration{});
  EXPECT_LT(*error, seconds(1));
}

}  // namespace
}  // namespace pitwall::transport
