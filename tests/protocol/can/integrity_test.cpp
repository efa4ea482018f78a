// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/integrity.hpp"

#include <gtest/gtest.h>

#include "protocol/can/av21.hpp"

namespace pitwall::can {
namespace {

TEST(Integrity, ACounterThatCountsIsNeverBadWhateverItsWrap) {
  for (const std::uint32_t wrap : {2U, 7U, 8U, 10U, 16U, 255U, 256U}) {
    for (const std::uint32_t first : {0U, 1U}) {
      CounterMonitor monitor;
      for (std::uint32_t i = 0; i < 1000; ++i) {
        const CounterVerdict v = judge(monitor, first + i % (wrap - first));
        const bool is_stuck = wrap - first == 1 && i > 0;
        EXPECT_EQ(v, i == 0     ? CounterVerdict::kFirst
                     : is_stuck ? CounterVerdict::kStuck
                                : CounterVerdict::kChanged)
            << wrap << " " << i;
      }
    }
  }
}

TEST(Integrity, AStuckCounterDegradesAtThreeAndFailsAtFive) {
  CounterMonitor monitor;
  (void)judge(monitor, 9);
  for (int bad = 1; bad <= 20; ++bad) {
    EXPECT_EQ(judge(monitor, 9), CounterVerdict::kStuck);
    EXPECT_EQ(monitor.is_degraded(), bad >= 3);
    EXPECT_EQ(monitor.is_fault(), bad >= 5);
  }
  for (std::uint32_t good = 1; good <= 5; ++good) {
    EXPECT_EQ(judge(monitor, 9 + good), CounterVerdict::kChanged);
    EXPECT_FALSE(monitor.is_fault());
  }
  EXPECT_EQ(monitor.debt, 0);
}

TEST(Integrity, JumpsAreToldApartAndBadOnlyIfTheRuleSaysSo) {
  CounterMonitor strict, lenient;
  std::uint32_t value = 40;
  (void)judge(strict, value);
  (void)judge(lenient, value, {.bits = 8, .jump_is_bad = false});
  for (int i = 0; i < 5; ++i) {
    value = (value + 37) & 0xFFU;
    EXPECT_EQ(judge(strict, value), CounterVerdict::kJumped);
    EXPECT_EQ(judge(lenient, value, {.bits = 8, .jump_is_bad = false}), CounterVerdict::kJumped);
  }
  EXPECT_TRUE(strict.is_fault());
  EXPECT_EQ(lenient.debt, 0);
  CounterMonitor backwards;
  (void)judge(backwards, 200);
  EXPECT_EQ(judge(backwards, 199), CounterVerdict::kJumped);
}

TEST(Integrity, OneLostFrameIsForgiven) {
  CounterMonitor monitor;
  for (const std::uint32_t v : {10U, 11U, 13U, 14U}) (void)judge(monitor, v);
  EXPECT_EQ(monitor.debt, 0);
}

TEST(Integrity, ReadsTheCounterOfEveryGeneratedRow) {
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

TEST(Integrity, LivenessByAge) {
  const MessageRow row{1,
                       8,
                       "m",
                       Direction::kFromCar,
                       SafetyClass::kStatus,
                       true,
                       milliseconds(10),
                       milliseconds(50),
                       false,
                       0,
                       0};
  const Instant heard{1'000'000'000};
  EXPECT_EQ(liveness(row, std::nullopt, heard), Liveness::kNever);
  for (int age_ms = 0; age_ms < 100; ++age_ms) {
    EXPECT_EQ(liveness(row, heard, heard + milliseconds(age_ms)), age_ms > 50   ? Liveness::kLost
                                                                  : age_ms > 25 ? Liveness::kLate
                                                                                : Liveness::kFresh);
  }
}

}  // namespace
}  // namespace pitwall::can
