// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/message_monitor.hpp"

#include <gtest/gtest.h>

#include "protocol/can/av21.hpp"
#include "tests/protocol/can/bus_trace.hpp"
#include "tests/protocol/can/monitor_alone.hpp"

namespace pitwall::can {
namespace {

struct Cycle {
  std::uint32_t bottom, top;
};
constexpr Cycle kCycles[] = {{0, 1},  {0, 7},  {0, 8},  {0, 9},   {0, 14},
                             {0, 15}, {1, 15}, {1, 99}, {1, 255}, {0, 255}};
constexpr int kPeriods_ms[] = {5, 10, 20, 50, 100, 160, 200, 500, 1000};

std::int64_t losses_before(const std::vector<Send>& sends, std::int64_t index) {
  std::int64_t run = 0;
  while (sends[static_cast<std::size_t>(index - 1 - run)].is_lost) ++run;
  return run;
}

// The law of the header: each lost send is blamed once, no other is, and in time.
void expect_every_loss_once(const SenderTiming& timing, bool has_counter, Random& noise) {
  const std::vector<Send> sends = trace(timing, noise);
  const MessageRow row = row_of(timing, has_counter);
  const Received received = run_monitor(row, sends, milliseconds(150));
  std::int64_t last_received = 0;
  std::uint32_t lost = 0;
  for (std::size_t i = 0; i < sends.size(); ++i) {
    if (!sends[i].is_lost) last_received = static_cast<std::int64_t>(i);
  }
  auto blame = blamed(sends, timing.period, received.reports);
  for (std::size_t i = 0; i < sends.size(); ++i) {
    const auto index = static_cast<std::int64_t>(i);
    const bool is_trailing = index > last_received;
    const bool is_owed = sends[i].is_lost && (!is_trailing || index <= last_received + 5);
    ASSERT_EQ(blame[index], is_owed ? 1 : 0)
        << "send " << i << " of period " << timing.period.ns << " top " << timing.top;
    lost += sends[i].is_lost ? 1U : 0U;
  }
  for (const LossReport& r : received.reports) {
    EXPECT_EQ(r.id, row.id);
    const std::int64_t index = nearest_send(sends, timing.period, r.due);
    if (index >= static_cast<std::int64_t>(sends.size())) continue;  // after the end of the trace
    const Instant due = sends[static_cast<std::size_t>(index)].due;
    if (losses_before(sends, index) >= 5) continue;  // past the timeout: by the frame that ends it
    EXPECT_LE(r.due - due, timing.delay_max);
    EXPECT_LE(due - r.due, timing.delay_max);
    EXPECT_LE(r.noticed - r.due, tolerance_of(row) + kTick + timing.delay_max);
  }
  EXPECT_EQ(received.monitor.late, 0U);
  EXPECT_GE(received.monitor.lost, lost);  // and those that were due after the end
}

TEST(MessageMonitor, EveryLossIsReportedOnceAndNothingElse) {
  Random noise{11};
  for (const int period_ms : kPeriods_ms) {
    for (const Cycle& cycle : kCycles) {
      for (const double loss : {0.0, 0.02, 0.3}) {
        SenderTiming timing{.period = milliseconds(period_ms),
                            .bottom = cycle.bottom,
                            .top = cycle.top,
                            .loss = loss,
                            .sends = 300};
        for (const int percent : {0, 50, 99}) {
          timing.delay_max = tolerance_of(row_of(timing, true)) * percent / 100;
          expect_every_loss_once(timing, true, noise);
          if (cycle.top == 7) expect_every_loss_once(timing, false, noise);
          if (HasFatalFailure()) return;
        }
      }
    }
  }
}

// Known from the start, as by a protection profile.
TEST(MessageMonitor, TheCounterFindsTheTotalsUnderLargeDelays) {
  Random noise{12};
  for (const Cycle& cycle : {Cycle{0, 14}, Cycle{0, 15}, Cycle{0, 255}}) {
    for (const double loss : {0.0, 0.05, 0.2}) {
      for (const int periods : {1, 2, 3}) {
        const SenderTiming timing{.delay_max = milliseconds(10) * periods,
                                  .bottom = cycle.bottom,
                                  .top = cycle.top,
                                  .loss = loss,
                                  .sends = 2000};
        std::vector<Send> sends = trace(timing, noise);
        sends.back().is_lost = false;
        const Received received =
            run_monitor(row_of(timing, true), sends, kTick,
                        {.top = cycle.top, .bottom = 0, .seen = CounterCycle::kKnown});
        const auto lost =
            std::count_if(sends.begin(), sends.end(), [](const Send& s) { return s.is_lost; });
        EXPECT_EQ(received.monitor.lost, lost) << cycle.top << " " << loss << " " << periods;
        std::uint32_t reported = 0;
        for (const LossReport& r : received.reports) reported += r.frames;
        EXPECT_EQ(reported, received.monitor.lost + received.monitor.late);
      }
    }
  }
}

TEST_F(MonitorAlone, NeverHeardIsNeverOverdue) {
  for (std::int64_t t = 0; t < 1000; t += 10) look(t);
  EXPECT_EQ(log.count, 0U);
  EXPECT_EQ(monitor.lost, 0U);
}

TEST_F(MonitorAlone, ASilenceIsReportedAtOnceUpToTheTimeoutAndThenCounted) {
  receive(0, 7);
  look(10);
  EXPECT_EQ(log.count, 0U);
  look(20);
  ASSERT_EQ(log.count, 1U);
  EXPECT_EQ(log.reports[0].due, Instant{} + milliseconds(10));
  EXPECT_EQ(log.reports[0].noticed, Instant{} + milliseconds(20));
  EXPECT_EQ(log.reports[0].sign, LossSign::kPeriod);
  for (std::int64_t t = 30; t <= 100'000; t += 10) look(t);
  EXPECT_EQ(log.count, 5U) << "one each, until the timeout of 50 ms";
  EXPECT_EQ(monitor.lost, 9999U);
  receive(100'000'000, (7 + 10'000) % 256);
  ASSERT_EQ(log.count, 6U);
  EXPECT_EQ(log.reports[5].frames, 9999U - 5U);
  EXPECT_EQ(log.reports[5].due, Instant{} + milliseconds(60));
  EXPECT_EQ(monitor.lost, 9999U);
  EXPECT_EQ(monitor.late, 0U);
  EXPECT_EQ(monitor.mean_interval, Duration{}) << "a silence is no interval";
}

TEST_F(MonitorAlone, AFrameThatComesAfterAllTakesItsLossBack) {
  receive(0, 1);
  look(20);
  EXPECT_EQ(monitor.lost, 1U);
  EXPECT_EQ(receive(22'000, 2), FrameVerdict::kGood);
  EXPECT_EQ(monitor.lost, 0U);
  EXPECT_EQ(monitor.late, 1U);
  receive(23'000, 3);  // catching up
  look(30);
  EXPECT_EQ(reported(), 1U);
  EXPECT_EQ(monitor.debt, 0);
}

TEST_F(MonitorAlone, WithoutACounterABurstAfterAPauseIsLateToo) {
  row.has_counter = false;
  receive(0, 0);
  for (std::int64_t t = 10; t <= 40; t += 10) look(t);
  for (int i = 0; i < 4; ++i) receive(41'000 + 100 * i, 0);
  EXPECT_EQ(monitor.lost, 0U);
  EXPECT_EQ(monitor.late, 3U);
  EXPECT_EQ(reported(), 3U);
}

TEST_F(MonitorAlone, ARestartIsNoLossWhereverItHappens) {
  for (std::uint32_t before = 0; before < 256; ++before) {
    for (const std::uint32_t first : {0U, 1U}) {
      for (const bool is_known : {false, true}) {
        monitor = {};
        receive(0, before);
        if (is_known) monitor.cycle = {.top = 255, .seen = CounterCycle::kKnown};
        const FrameVerdict verdict = receive(10'000, first);
        EXPECT_EQ(verdict == FrameVerdict::kStuckCounter, before == first);
        const bool is_next_but_one = is_known && before + 2 == first + 256;
        EXPECT_EQ(monitor.lost, is_next_but_one ? 1U : 0U) << before;
        EXPECT_EQ(monitor.debt, before == first || is_next_but_one ? 1 : 0) << before;
      }
    }
  }
}

TEST_F(MonitorAlone, AfterTwoWrapsAWrapWithLossesIsJudgedByTheCounter) {
  std::int64_t t_us = 0;
  const auto count_to = [&](std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t c = from; c <= to; ++c) receive(t_us += 10'000, c);
  };
  count_to(0, 7);
  count_to(0, 7);
  EXPECT_FALSE(monitor.cycle.is_known());
  count_to(0, 5);
  EXPECT_TRUE(monitor.cycle.is_known());
  EXPECT_EQ(monitor.cycle.length(), 8U);
  receive(t_us += 24'000, 0);  // 6 and 7 are gone; by time alone only one would be
  EXPECT_EQ(monitor.lost, 2U);
  receive(t_us += 10'000, 9);  // not that cycle after all
  EXPECT_FALSE(monitor.cycle.is_known());
}

TEST_F(MonitorAlone, RepeatedAndDoubledFramesAreNoLosses) {
  for (const int frozen : {1, 2, 3, 10, 100}) {
    monitor = {};
    std::int64_t t_us = 0;
    receive(t_us, 20);
    for (int i = 0; i < frozen; ++i) {
      EXPECT_EQ(receive(t_us += 10'000, 20), FrameVerdict::kStuckCounter);
      look(t_us / 1000);
    }
    MessageMonitor sender_rested = monitor;
    receive(t_us += 10'000, 21 + static_cast<std::uint32_t>(frozen));  // it had counted on
    EXPECT_EQ(monitor.lost, 0U) << frozen;
    std::swap(monitor, sender_rested);
    receive(t_us, 21);
    EXPECT_EQ(monitor.lost, 0U) << frozen;
    EXPECT_EQ(monitor.debt, std::min(frozen, 10) - 1);
  }
  monitor = {};
  for (std::uint32_t i = 0; i < 100; ++i) {
    receive(10'000 * i, i);
    EXPECT_EQ(receive(10'000 * i + 4900, i), FrameVerdict::kStuckCounter);
    look(10 * i);
  }
  look(1006);
  EXPECT_EQ(monitor.lost, 1U) << "a double does not move what is due";
  EXPECT_EQ(log.count, 1U);
}

TEST_F(MonitorAlone, AJumpBeyondAllTimeIsBadButNoLoss) {
  std::int64_t t_us = 0;
  std::uint32_t counter = 2;
  receive(t_us, counter);
  for (int bad = 1; bad <= 20; ++bad) {
    counter = 2 + (counter + 35) % 250;
    const FrameVerdict verdict = receive(t_us += 10'000, counter);
    EXPECT_EQ(verdict, bad < 5 ? FrameVerdict::kGood : FrameVerdict::kJumpedCounter) << bad;
    EXPECT_EQ(monitor.debt, std::min(bad, 10));
  }
  EXPECT_EQ(monitor.lost, 0U);
  EXPECT_EQ(monitor.bad, 16U);
  for (int good = 1; good <= 6; ++good) {
    const FrameVerdict verdict = receive(t_us += 10'000, ++counter);
    EXPECT_EQ(verdict, good < 6 ? FrameVerdict::kJumpedCounter : FrameVerdict::kGood);
  }
}

TEST_F(MonitorAlone, LossesThatTimeExplainsFillNoBucket) {
  std::int64_t t_us = 0;
  for (std::uint32_t i = 0; i < 200; i += 3) receive(t_us += 30'000, i);
  EXPECT_EQ(monitor.debt, 0);
  EXPECT_EQ(monitor.bad, 0U);
  EXPECT_EQ(monitor.lost, 132U);
}

TEST_F(MonitorAlone, ACounterThatMayRestIsJudgedByTimeAlone) {
  rules.use_counter = false;
  for (std::int64_t t_us = 0; t_us < 1'000'000; t_us += 10'000) {
    EXPECT_EQ(receive(t_us, 9), FrameVerdict::kGood);
  }
  EXPECT_EQ(monitor.bad, 0U);
  receive(1'010'000, 9);
  EXPECT_EQ(monitor.lost, 1U);
}

TEST_F(MonitorAlone, WithoutAPeriodOnlyTheCounterSpeaks) {
  row.period = row.timeout = {};
  receive(0, 4);
  look(100'000);
  EXPECT_EQ(monitor.lost, 0U);
  receive(3'000'000, 7);
  EXPECT_EQ(monitor.lost, 2U);
  receive(9'000'000, 0);
  EXPECT_EQ(monitor.lost, 2U);
}

TEST_F(MonitorAlone, StampsThatStepNeitherHangNorInvent) {
  receive(5'000'000, 1);
  receive(0, 2);  // five seconds back
  EXPECT_EQ(monitor.lost, 0U);
  look(10);
  EXPECT_EQ(log.count, 0U);
  look(20);
  EXPECT_EQ(log.count, 1U);
  receive(std::int64_t{3600} * 24 * 365 * 100 * 1'000'000, 3);  // a century on
  EXPECT_LE(monitor.lost, 1'000'000'000U);
}

TEST_F(MonitorAlone, TheMeanIntervalIsWhatArrives) {
  for (std::uint32_t i = 0; i < 100; ++i) receive(12'000 * i, i);
  EXPECT_EQ(monitor.mean_interval, milliseconds(12));
}

TEST_F(MonitorAlone, TheMeanIntervalFollowsByAnEighthAndSilencesAreNone) {
  receive(0, 0);
  receive(10'000, 1);
  receive(28'000, 2);
  EXPECT_EQ(monitor.mean_interval, milliseconds(11));
  receive(28'000, 3);  // two at once
  EXPECT_EQ(monitor.mean_interval, microseconds(9'625));
  const Duration before = monitor.mean_interval;
  receive(20'000, 4);  // stamps that step back
  EXPECT_EQ(monitor.mean_interval, before);
  receive(20'000 + 50'001, 9);
  EXPECT_EQ(monitor.mean_interval, before) << "longer than the timeout";
  receive(70'001 + 50'000, 14);
  EXPECT_EQ(monitor.mean_interval, before + (milliseconds(50) - before) / 8) << "the timeout";
  row.timeout = {};
  receive(120'001 + 8'000'000, 15);
  EXPECT_GT(monitor.mean_interval, seconds(1)) << "without a timeout nothing is a silence";
}

TEST_F(MonitorAlone, TimeIsRoundedToTheNearestPeriodAndUpAtTheHalf) {
  receive(0, 3);
  receive(4'999, 3);  // a repetition within half a period is additional
  watch({&row, 1}, {&monitor, 1}, Instant{} + microseconds(15'001), log);
  EXPECT_EQ(monitor.lost, 1U);
  monitor = {};
  receive(0, 3);
  receive(5'000, 3);  // and in its own time from there on
  watch({&row, 1}, {&monitor, 1}, Instant{} + microseconds(15'001), log);
  EXPECT_EQ(monitor.lost, 0U);
  row.has_counter = false;
  for (const auto& [at_us, lost] : {std::pair{14'999, 0U}, std::pair{15'000, 1U}}) {
    monitor = {};
    receive(0, 0);
    receive(at_us, 0);
    EXPECT_EQ(monitor.lost, lost) << at_us;
  }
}

// Steps of the counter against what time allows: to twice of it they are believed, and bad.
TEST_F(MonitorAlone, ACounterIsBelievedToTwiceWhatTimeAllows) {
  for (const auto& [steps, lost] : {std::pair{1U, 0U}, {2U, 1U}, {4U, 3U}, {5U, 0U}}) {
    monitor = {};
    receive(0, 10);
    receive(10'000, 10 + steps);
    EXPECT_EQ(monitor.lost, lost) << steps;
    EXPECT_EQ(monitor.debt, steps > 1 ? 1 : 0) << steps;
  }
}

// Repeated frames were sends or they were not: whichever fits the time.
TEST_F(MonitorAlone, RepeatedFramesWereSendsWhereThatFitsTheTime) {
  struct Rest {
    int repeated;
    std::int64_t periods;
    std::uint32_t steps, lost;
  };
  for (const Rest& r : {Rest{2, 1, 3, 0}, Rest{2, 3, 4, 1}, Rest{3, 3, 4, 3}, Rest{2, 1, 2, 1},
                        Rest{2, 1, 4, 1}, Rest{2, 4, 4, 3}}) {
    monitor = {};
    std::int64_t t_us = 0;
    receive(t_us, 30);
    for (int i = 0; i < r.repeated; ++i) receive(t_us += 10'000, 30);
    receive(t_us + 10'000 * r.periods, 30 + r.steps);
    EXPECT_EQ(monitor.lost, r.lost) << r.repeated << " " << r.periods << " " << r.steps;
  }
}

TEST_F(MonitorAlone, WithinHalfACycleTheSameValueIsRepeated) {
  for (const auto& [periods, verdict] :
       {std::pair{4, FrameVerdict::kStuckCounter}, std::pair{5, FrameVerdict::kGood}}) {
    monitor = {};
    receive(0, 2);
    monitor.cycle = {.top = 7, .bottom = 0, .seen = CounterCycle::kKnown};
    EXPECT_EQ(receive(10'000 * periods, 2), verdict) << periods;
  }
}

TEST_F(MonitorAlone, ACycleThatBeginsAtOneIsLearnedToo) {
  std::int64_t t_us = 0;
  for (int round = 0; round < 3; ++round)
    for (std::uint32_t c = 1; c <= 7; ++c) receive(t_us += 10'000, c);
  EXPECT_TRUE(monitor.cycle.is_known());
  EXPECT_EQ(monitor.cycle.bottom, 1U);
  EXPECT_EQ(monitor.cycle.length(), 7U);
}

// A sender that is behind may have sent that many more since it began anew.
TEST_F(MonitorAlone, ARestartIsAJumpWhereTimeDoesNotReachIts) {
  for (const std::uint32_t restarted_at : {4U, 5U}) {
    monitor = {};
    receive(0, 100);
    receive(20'000, 101);  // one behind
    receive(50'000, restarted_at);
    EXPECT_EQ(monitor.debt, restarted_at == 5 ? 1 : 0);
  }
}

TEST_F(MonitorAlone, AFullLogCountsWhatItCannotList) {
  std::int64_t t_us = 0;
  for (std::uint32_t i = 0; i < 200; i += 2) receive(t_us += 20'000, i);
  EXPECT_EQ(log.count, LossLog::kMax);
  EXPECT_EQ(log.unlisted, 99U - LossLog::kMax);
}

TEST_F(MonitorAlone, OverdueIsLaterThanTheSlackNotAtIt) {
  receive(0, 3);
  watch({&row, 1}, {&monitor, 1}, Instant{} + microseconds(15'000), log);
  EXPECT_EQ(log.count, 0U);
  watch({&row, 1}, {&monitor, 1}, Instant{} + microseconds(15'000) + nanoseconds(1), log);
  EXPECT_EQ(log.count, 1U);
  watch({&row, 1}, {&monitor, 1}, Instant{} + microseconds(25'000), log);
  EXPECT_EQ(log.count, 1U);
  log.clear();
  monitor = {};
  row.timeout = {};
  receive(0, 3);
  look(200);
  EXPECT_EQ(reported(), 1U) << "the first one is always named";
}

TEST_F(MonitorAlone, OfTheStepsOfACycleTheNearestToTheTimeIsTaken) {
  const CounterCycle eight{.top = 7, .bottom = 0, .seen = CounterCycle::kKnown};
  receive(0, 2);
  monitor.cycle = eight;
  EXPECT_EQ(receive(80'000, 2), FrameVerdict::kGood) << "all of a cycle is lost, none is repeated";
  EXPECT_EQ(monitor.lost, 7U);
  receive(200'000, 7);  // 5 or 13 steps in 12 periods
  EXPECT_EQ(monitor.lost, 7U + 12U);
  for (int i = 1; i <= 9; ++i) receive(200'000 + 10'000 * i, 7);
  receive(300'000, 1);  // ten steps on, of which nine could not be read
  EXPECT_EQ(monitor.lost, 7U + 12U);
  EXPECT_TRUE(monitor.cycle.is_known());
  monitor = {};
  receive(0, 5);
  receive(90'000, 6);  // unknown cycle, and nine periods: it went round
  EXPECT_EQ(monitor.lost, 8U);
}

TEST_F(MonitorAlone, ASenderThatRestedAndLostFramesIsBelieved) {
  receive(0, 30);
  receive(10'000, 30);
  receive(20'000, 30);
  receive(60'000, 34);
  EXPECT_EQ(monitor.lost, 3U);
}

TEST_F(MonitorAlone, LossesWithinABurstAreFound) {
  receive(0, 40);
  receive(200'000, 41);  // a pause, then all of it at once
  receive(200'100, 52);  // ten of them did not come through
  EXPECT_EQ(monitor.debt, 0);
  receive(200'200, 53);
  EXPECT_EQ(monitor.lost, 10U);
  EXPECT_EQ(monitor.debt, 0);
  receive(200'300, 3);  // an unknown cycle ends in the burst
  EXPECT_EQ(monitor.debt, 0);
  EXPECT_EQ(monitor.lost, 10U);
}

TEST_F(MonitorAlone, ALateFrameAfterZeroIsLateToo) {
  receive(0, 0);
  look(20);
  receive(22'000, 1);
  EXPECT_EQ(monitor.lost, 0U);
  EXPECT_EQ(monitor.late, 1U);
}

TEST_F(MonitorAlone, OnlyWrapsWithoutLossOrRestTeachTheCycle) {
  std::int64_t t_us = 0;
  for (int round = 0; round < 4; ++round) {
    for (std::uint32_t c = 0; c <= 6; ++c) receive(t_us += 10'000, c);
    t_us += 10'000;  // 7 is lost
  }
  EXPECT_FALSE(monitor.cycle.is_known());
  EXPECT_EQ(monitor.lost, 3U);
  monitor = {};
  for (int round = 0; round < 4; ++round) {
    for (std::uint32_t c = 0; c <= 6; ++c) receive(t_us += 10'000, c);
    receive(t_us += 10'000, 6);  // 7 has come as 6
  }
  EXPECT_FALSE(monitor.cycle.is_known());
  monitor = {};
  for (int round = 0; round < 3; ++round) {
    for (std::uint32_t c = 0; c <= 7; ++c) receive(t_us += 10'000, c);
  }
  for (std::uint32_t c = 0; c <= 6; ++c) receive(t_us += 10'000, c);
  receive(t_us += 14'000, 0);  // early, and 7 is lost
  EXPECT_TRUE(monitor.cycle.is_known());
  EXPECT_EQ(monitor.lost, 1U);
}

TEST_F(MonitorProtected, TheProfileFixesTheCycle) {
  hear_protected(0, 13);
  hear_protected(14'000, 0);  // 14 is lost; by time alone nothing is
  EXPECT_EQ(monitor.lost, 1U);
  for (const std::int64_t t_us : {20'000, 30'000}) {
    hear_protected(t_us, 7);
    hear_protected(t_us + 5'000, 0);  // restarts teach nothing
  }
  EXPECT_EQ(monitor.cycle.length(), 15U);
  EXPECT_TRUE(monitor.cycle.is_known());
}

TEST_F(MonitorProtected, ADamagedFrameCameAndAForgedOneDidNot) {
  hear_protected(0, 1);
  EXPECT_EQ(hear_protected(4'000, 9, true), FrameVerdict::kWrongChecksum);
  look(16);
  EXPECT_EQ(monitor.lost, 1U) << "the forged one has not moved what is due at 10 ms";
  monitor = {};
  for (std::uint32_t i = 0; i < 10; ++i) {
    const FrameVerdict verdict = hear_protected(10'000 * i, i, i > 0);
    EXPECT_EQ(verdict, i > 0 ? FrameVerdict::kWrongChecksum : FrameVerdict::kGood);
    EXPECT_EQ(monitor.debt, i);
  }
  EXPECT_EQ(hear_protected(100'000, 10), FrameVerdict::kJumpedCounter) << "not trusted at once";
  EXPECT_EQ(monitor.lost, 0U);
}

TEST(MessageMonitor, ReadsTheCounterOfEveryGeneratedRow) {
  for (const MessageRow& row : av21::kMessages) {
    if (!row.has_counter) continue;
    Frame f{.id = row.id, .length = row.length, .data = {}};
    f.data.fill(0xFF);
    EXPECT_EQ(counter_of(row, f), (1U << row.counter_bits) - 1) << row.name;
    f.data.fill(0);
    EXPECT_EQ(counter_of(row, f), 0U);
  }
  av21::MiscReport report;
  for (double av21::MiscReport::*field : av21::MiscReport::kFields) report.*field = 0;
  report.raptor_rolling_counter = 201;
  report.mode_switch_state = 1;
  Frame f;
  EncodeCounters counters;
  ASSERT_TRUE(av21::encode(report, f, counters));
  for (const MessageRow& row : av21::kMessages) {
    if (row.id != av21::MiscReport::kId) continue;
    EXPECT_EQ(counter_of(row, f), 201U);
  }
}

}  // namespace
}  // namespace pitwall::can
