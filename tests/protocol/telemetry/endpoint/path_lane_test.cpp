// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/endpoint/path_lane.hpp"

#include <gtest/gtest.h>

#include "protocol/telemetry/packet/header.hpp"
#include "tests/support/instants.hpp"

namespace pitwall::telemetry {
namespace {

TEST(PathLane, UseIsTheShareOfTheRateInTheLastSecond) {
  PathLane lane{BudgetParams{}};
  EXPECT_EQ(lane.use(at_ms(500)), 0.0);
  (void)lane.budget.room_for_all(at_ms(-5'000));
  for (std::int64_t ms = 0; ms < 5'000; ms += 20) lane.spend(292, 0, at_ms(ms));  // 320 on the wire
  EXPECT_NEAR(lane.use(at_ms(5'000)), 0.5, 0.02);  // 16 000 of 32 000 bytes
  EXPECT_NEAR(lane.use(at_ms(5'450)), 0.3, 0.06);
  EXPECT_EQ(lane.use(at_ms(6'200)), 0.0);
  EXPECT_EQ(lane.use(at_ms(60'000)), 0.0);
}

TEST(PathLane, FitsWhatMayBeSpent) {
  PathLane lane{BudgetParams{}};
  for (std::int64_t ms = 0; ms < 3'000; ++ms) {
    std::size_t size = 0;
    while (lane.fits(size + 1, 40, at_ms(ms))) ++size;
    EXPECT_EQ(size, lane.budget.room_beside(40, at_ms(ms)));
    if (size > 0 && ms % 7 == 0) lane.spend(size, 40, at_ms(ms));
  }
}

TEST(PathLane, AQueueThatGrowsTakesTheRateBackButNotSafetys) {
  PathLane lane{BudgetParams{}};
  for (std::int64_t i = 0; i < 250; ++i) {
    const Instant sent = at_ms(20 * i);
    const Duration queue = milliseconds(5) * i;  // a quarter of a second each second
    lane.rate.delivered(sent, sent + milliseconds(15) + queue, 600,
                        sent + milliseconds(30) + queue);
    lane.adapt(sent);
  }
  EXPECT_LT(lane.factor, 0.9);
  for (std::int64_t ms = 6'000; ms < 8'000; ms += 20) {
    ASSERT_TRUE(lane.fits(60, 60, at_ms(ms)));  // 4 400 bytes a second are safety's
    lane.spend(60, 60, at_ms(ms));
  }
}

// Half the rate is spent where half may be, by who takes all there is; safety keeps its own.
TEST(PathLane, ACapIsKeptAndSafetyIsNotCapped) {
  const auto spent = [](double cap) {
    PathLane lane{BudgetParams{}};
    lane.cap = cap;
    for (std::int64_t ms = 0; ms < 10'000; ms += 10) {
      lane.adapt(at_ms(ms));
      const std::size_t room = lane.budget.room_for_all(at_ms(ms));
      if (room > 0) lane.spend(room, 0, at_ms(ms));
    }
    return static_cast<double>(lane.budget.counters().bytes);
  };
  EXPECT_LT(spent(0.5), 0.6 * spent(1.0));
  PathLane lane{BudgetParams{}};
  lane.cap = 0.05;
  for (std::int64_t ms = 2'000; ms < 4'000; ms += 20) {
    lane.adapt(at_ms(ms));
    if (ms < 3'000) continue;  // the share fills
    ASSERT_TRUE(lane.fits(60, 60, at_ms(ms)));
    lane.spend(60, 60, at_ms(ms));
  }
}

}  // namespace
}  // namespace pitwall::telemetry
