// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/busy_budget.hpp"

#include <gtest/gtest.h>

#include <random>

namespace pitwall::replay {
namespace {

// Waits of any length, busy whenever there is credit: over any stretch no more than the law says.
TEST(BusyBudget, NoStretchOfTimeIsBusierThanAQuarterAndAFixedRest) {
  std::mt19937_64 random{5};
  for (int run = 0; run < 20; ++run) {
    BusyBudget budget;
    struct Point {
      Instant at;
      Duration spent;  // since the start
    };
    std::vector<Point> points{{Instant{}, Duration{}}};
    const Duration wait_most = microseconds(200);
    for (int i = 0; i < 2'000; ++i) {
      const Duration wait{static_cast<std::int64_t>(random() % 200'000U)};
      const Instant now = points.back().at;
      const Duration busy = budget.has_credit(now) ? wait : Duration{};
      budget.spend(busy);
      points.push_back({now + wait, points.back().spent + busy});
    }
    for (std::size_t a = 0; a < points.size(); a += 37)
      for (std::size_t b = a; b < points.size(); b += 11) {
        const Duration spent = points[b].spent - points[a].spent;
        const Duration time = points[b].at - points[a].at;
        ASSERT_LE(spent, BusyBudget::kMost + time / BusyBudget::kShare + wait_most);
      }
    EXPECT_GT(points.back().spent, (points.back().at - Instant{}) / (2 * BusyBudget::kShare));
  }
}

TEST(BusyBudget, APauseGivesBackNoMoreThanTheMost) {
  BusyBudget budget;
  EXPECT_TRUE(budget.has_credit(Instant{}));
  budget.spend(BusyBudget::kMost);
  EXPECT_FALSE(budget.has_credit(Instant{}));
  EXPECT_TRUE(budget.has_credit(Instant{} + seconds(3'600)));
  budget.spend(BusyBudget::kMost);
  EXPECT_FALSE(budget.has_credit(Instant{} + seconds(3'600)));
}

}  // namespace
}  // namespace pitwall::replay
