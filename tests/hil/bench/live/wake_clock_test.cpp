// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/wake_clock.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "hil/bench/live/virtual_machine.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::bench {
namespace {

constexpr Duration kPeriod = milliseconds(2);

TEST(WakeClock, NeverWakesEarlyAndCountsEveryWakeUpOnce) {
  constexpr int kWakes = 50;
  WakeClock clock(kPeriod, kWakes * kPeriod);
  clock.start();
  for (int i = 1; i <= kWakes; ++i) {
    clock.sleep_until(Instant{} + i * kPeriod);
    EXPECT_GE(transport::monotonic_now(), clock.started() + i * kPeriod);
  }
  const RealTime report = clock.report();
  ASSERT_EQ(report.wake_late.size(), RealTime::kWakeBins);
  const auto slept = std::accumulate(report.wake_late.begin(), report.wake_late.end(), 0ULL);
  EXPECT_LE(slept + report.caught_up_wakes, static_cast<unsigned>(kWakes));
  if (slept > 0) {
    EXPECT_LE(0.0, report.wake_late_p50_us);
    EXPECT_LE(report.wake_late_p50_us, report.wake_late_p99_us);
    EXPECT_LE(report.wake_late_p99_us, report.wake_late_max_us);
  }
}

TEST(WakeClock, ALateOneIsCaughtUpAtOnceAndCounted) {
  WakeClock clock(kPeriod, 10 * kPeriod);
  clock.start();
  transport::sleep_until(clock.started() + 5 * kPeriod);
  for (int i = 1; i <= 4; ++i) clock.sleep_until(Instant{} + i * kPeriod);
  const RealTime report = clock.report();
  EXPECT_EQ(report.caught_up_wakes, 4u) << "each of them began at least a period late";
  EXPECT_EQ(std::accumulate(report.wake_late.begin(), report.wake_late.end(), 0ULL), 0u);
  EXPECT_GE(report.behind_max, 4 * kPeriod) << "the first of them was due so long ago";
  EXPECT_GE(report.behind_at, Instant{} + kPeriod);
}

// In a process of its own: a program has one clock.
TEST(WakeClock, ByBenchTimeALateWakeUpCostsNone) {
  const auto folder = transport::TemporaryFolder::create("pitwall-wake-clock-");
  ASSERT_TRUE(folder);
  const std::string file = folder->path() + "/clock";
  const auto run = [&file] {
    if (!transport::use_clock(file)) return 2;
    auto time = BenchTime::open(file, "");
    if (!time) return 3;
    WakeClock clock(kPeriod, 20 * kPeriod, *std::move(time));
    clock.begin();
    const Instant begun = transport::monotonic_now();
    transport::nap(20 * kPeriod);  // as a program that is slow to start
    if (transport::monotonic_now() - begun > transport::ClockKeeper::kLead) return 7;
    clock.sleep_for(5 * kPeriod);
    if (transport::monotonic_now() - begun < 5 * kPeriod) return 8;
    clock.start();
    clock.sleep_until(Instant{} + kPeriod);
    transport::nap(20 * kPeriod);  // as a machine that had no processor for the bench
    for (int i = 2; i <= 10; ++i) clock.sleep_until(Instant{} + i * kPeriod);
    clock.stop();
    const RealTime report = clock.report();
    clock.end();
    if (report.behind_max > 2 * transport::ClockKeeper::kLead) return 4;
    if (!report.waits || report.waits->longest < 15 * kPeriod) return 5;
    if (report.waits->longest_at < Instant{}) return 9;
    return report.waits->longest_at - Instant{} <= 3 * kPeriod ? 0 : 6;
  };
  EXPECT_EXIT(::_exit(run()), ::testing::ExitedWithCode(0), "");
}

TEST(WakeClock, TellsWhatTheHostOfTheMachineTook) {
  WakeClock clock(kPeriod, 10 * kPeriod);
  const auto before = stolen_time();
  ASSERT_TRUE(before);
  clock.start();
  clock.sleep_until(Instant{} + kPeriod);
  clock.stop();
  const RealTime report = clock.report();
  EXPECT_GE(report.stolen_ms, 0.0);
  EXPECT_LE(report.stolen_ms, (*stolen_time() - *before).milliseconds());
}

TEST(RealTime, ARunThatFellFarBehindItsClockIsNotTimely) {
  RunResult run;
  EXPECT_TRUE(run.timely()) << "lockstep has no clock to keep up with";
  run.real_time.emplace();
  run.real_time->behind_max = milliseconds(40);
  EXPECT_TRUE(run.timely());
  run.real_time->behind_max = milliseconds(41);
  EXPECT_FALSE(run.timely());
}

}  // namespace
}  // namespace pitwall::bench
