// The monitor of a message at the limits of what time and counter can tell.
// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "protocol/can/message_monitor.hpp"
#include "tests/protocol/can/monitor_alone.hpp"

namespace pitwall::can {
namespace {

constexpr CounterCycle known(std::uint8_t bottom, std::uint8_t top) {
  return {.top = top, .bottom = bottom, .seen = CounterCycle::kKnown};
}

class MonitorLimits : public MonitorAlone {
 protected:
  // From the start of a monitor, ten milliseconds apart.
  void count(std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t c = from; c <= to; ++c) receive(t_us += 10'000, c);
  }
  std::int64_t t_us = 0;
};

TEST_F(MonitorLimits, ABurstTakesBackWhatWasMissingAndNoMore) {
  rules.use_counter = false;
  receive(0, 0);
  receive(30'000, 0);
  EXPECT_EQ(monitor.lost, 2U);
  for (int extra = 0; extra < 4; ++extra) receive(30'100 + 100 * extra, 0);
  EXPECT_EQ(monitor.lost, 0U);
  EXPECT_EQ(monitor.late, 2U);
}

TEST_F(MonitorLimits, EveryRowIsWatched) {
  const std::array<MessageRow, 3> rows{row, row, row};
  std::array<MessageMonitor, 3> monitors;
  for (MessageMonitor& m : monitors) judge(row, rules, m, {frame_of(row, 1), Instant{}}, log);
  watch(rows, monitors, Instant{} + milliseconds(20), log);
  for (const MessageMonitor& m : monitors) EXPECT_EQ(m.lost, 1U);
}

TEST_F(MonitorLimits, AClockThatStepsBackTakesNothingBack) {
  receive(0, 1);
  look(40);
  const std::uint32_t lost = monitor.lost;
  EXPECT_GT(lost, 1U);
  look(30);
  look(0);
  EXPECT_EQ(monitor.lost, lost);
}

TEST_F(MonitorLimits, OutsideItsCycleACounterIsJudgedWithoutIt) {
  receive(0, 7);
  monitor.cycle = known(0, 7);
  receive(170'000, 12);  // five steps on in seventeen periods
  EXPECT_EQ(monitor.lost, 16U);
  monitor = {};
  receive(0, 15);
  monitor.cycle = known(1, 15);
  receive(140'000, 0);  // a restart, and not a whole cycle
  EXPECT_EQ(monitor.lost, 13U);
}

TEST_F(MonitorLimits, OneWrapIsNoCycleYet) {
  count(0, 7);
  count(0, 5);
  receive(t_us += 24'000, 0);  // by a cycle of eight two would be missing
  EXPECT_EQ(monitor.lost, 1U);
}

TEST_F(MonitorLimits, TwoWrapsAtDifferentValuesAreNoCycle) {
  count(0, 7);
  count(0, 5);
  count(0, 3);
  EXPECT_FALSE(monitor.cycle.is_known());
}

TEST_F(MonitorLimits, AValueBeyondACycleBeginsItsLearningAnew) {
  count(0, 7);
  count(0, 8);
  receive(t_us += 10'000, 7);
  receive(t_us += 10'000, 0);
  EXPECT_FALSE(monitor.cycle.is_known());
}

TEST_F(MonitorLimits, ARepeatedFrameWasASendAlsoWithoutAPeriod) {
  row.period = row.timeout = {};
  receive(0, 5);
  EXPECT_EQ(receive(1'000, 5), FrameVerdict::kStuckCounter);
  receive(2'000, 7);
  EXPECT_EQ(monitor.lost, 0U);
}

TEST_F(MonitorLimits, AReadFrameEndsTheCountOfThoseThatWereNot) {
  receive(0, 5);
  receive(10'000, 5);
  receive(20'000, 6);
  receive(34'000, 8);  // early, and 7 is lost
  EXPECT_EQ(monitor.lost, 1U);
}

TEST_F(MonitorLimits, ADoubledFrameIsNoSend) {
  receive(0, 5);
  receive(1'000, 5);
  receive(24'000, 8);  // after two periods by time, three by its counter
  EXPECT_EQ(monitor.lost, 2U);
}

TEST_F(MonitorLimits, AShortCycleIsSteppedThroughForwards) {
  receive(0, 3);
  monitor.cycle = known(0, 4);
  receive(10'000, 2);  // four steps on
  EXPECT_EQ(monitor.lost, 3U);
}

TEST_F(MonitorLimits, OfTwoStepsThatFitTheNearerIsTakenFromTheMiddleOn) {
  for (const int periods : {4, 5, 6, 7, 8}) {
    monitor = {};
    receive(0, 2);
    monitor.cycle = known(0, 7);
    receive(10'000 * periods, 3);  // one step, or nine
    EXPECT_EQ(monitor.lost, periods < 5 ? 0U : 8U) << periods;
  }
}

TEST_F(MonitorLimits, TwoIsNoRestart) {
  receive(0, 14);
  monitor.cycle = known(0, 14);
  receive(10'000, 2);  // three steps on
  EXPECT_EQ(monitor.lost, 2U);
}

TEST_F(MonitorLimits, ARestartLateIsMissingByTime) {
  receive(0, 5);
  monitor.cycle = known(0, 14);
  receive(30'000, 0);  // ten steps on, or a restart
  EXPECT_EQ(monitor.lost, 2U);
  ASSERT_EQ(log.count, 1U);
  EXPECT_EQ(log.listed()[0].sign, LossSign::kPeriod);
}

TEST_F(MonitorLimits, TheSignSaysWhetherTimeOrCounterToldOfALoss) {
  const auto sign_after = [&](std::int64_t at_us, std::uint32_t value) {
    monitor = {};
    log.clear();
    receive(0, 20);
    receive(at_us, value);
    return log.count == 1 ? std::optional{log.listed()[0].sign} : std::nullopt;
  };
  EXPECT_EQ(sign_after(30'000, 23), LossSign::kCounter);
  EXPECT_EQ(sign_after(30'000, 20), LossSign::kPeriod) << "repeated";
  EXPECT_EQ(sign_after(30'000, 200), LossSign::kPeriod) << "a jump";
}

TEST_F(MonitorLimits, ACounterIsReadWhereverItsByteBegins) {
  for (const unsigned start : {0U, 4U, 8U, 28U, 52U, 56U, 60U}) {
    row.counter_start = static_cast<std::uint8_t>(start);
    row.counter_bits = 4;
    Frame frame{.id = row.id, .length = 8, .data = {}};
    frame.data[start / 8] = static_cast<std::uint8_t>(0x9U << start % 8);
    EXPECT_EQ(counter_of(row, frame), 9U) << start;
  }
}

class ProtectedLimits : public MonitorProtected {
 protected:
  std::int64_t t_us = 0;
};

TEST_F(ProtectedLimits, AFirstFrameThatIsDamagedIsBad) {
  EXPECT_EQ(hear_protected(0, 1, true), FrameVerdict::kWrongChecksum);
  EXPECT_EQ(monitor.bad, 1U);
  EXPECT_EQ(monitor.debt, 1);
}

TEST_F(ProtectedLimits, TheCounterOfADamagedFrameSaysNothing) {
  hear_protected(0, 13);
  hear_protected(10'000, 14, true);
  EXPECT_EQ(monitor.lost, 0U);
  EXPECT_EQ(log.count, 0U);
}

TEST_F(ProtectedLimits, ADamagedFrameTeachesNoCycle) {
  row.protection.profile = Protection::kJ1850;  // says nothing of counters
  const auto hear_j1850 = [&](std::uint32_t counter, bool is_damaged = false) {
    Frame frame = frame_of(row, counter);
    ProtectState state{counter};
    protect(row.protection, state, frame);
    if (is_damaged) frame.data[5] ^= 0x10U;
    t_us += 10'000;
    return judge(row, rules, monitor, {frame, Instant{} + microseconds(t_us)}, log);
  };
  for (std::uint32_t c = 0; c < 16; ++c) EXPECT_EQ(hear_j1850(c % 8), FrameVerdict::kGood) << c;
  EXPECT_EQ(hear_j1850(0, true), FrameVerdict::kWrongChecksum);
  EXPECT_FALSE(monitor.cycle.is_known());
}

}  // namespace
}  // namespace pitwall::can
