// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/budget_run.hpp"

#include <gtest/gtest.h>

namespace pitwall::radio {
namespace {

TEST(WorstWindow, IsFoundWhereverItBegins) {
  const auto at = [](std::int64_t ms) { return Instant{} + milliseconds(ms); };
  const std::vector<Departure> departures{{at(0), 100},   {at(90), 300}, {at(150), 300},
                                          {at(190), 300}, {at(191), 50}, {at(400), 10}};
  EXPECT_EQ(worst_window(departures, milliseconds(100)).bytes, 900U);
  EXPECT_EQ(worst_window(departures, milliseconds(101)).bytes, 950U);
  EXPECT_EQ(worst_window(departures, milliseconds(101)).packets, 4U);
  EXPECT_EQ(worst_window(departures, seconds(1)).bytes, 1'060U);
  EXPECT_EQ(worst_window({}, seconds(1)).packets, 0U);
}

TEST(BudgetVerdict, IsToldFromWhatLeft) {
  const telemetry::BudgetParams params;  // 32 000 B/s: 3 200 and one packet in 100 ms
  std::vector<Departure> departures;
  for (int i = 0; i < 11; ++i) departures.push_back({Instant{} + milliseconds(9 * i), 340});
  EXPECT_TRUE(judge(departures, params, "").holds());
  departures.push_back({Instant{} + milliseconds(99), 340});
  EXPECT_FALSE(judge(departures, params, "").holds());  // twelve packets
  departures.resize(5);
  departures.push_back({Instant{} + milliseconds(50), 3'000});
  EXPECT_FALSE(judge(departures, params, "").holds());  // too many bytes
}

TEST(BudgetRun, CountsBothDirectionsOfEachPath) {
  const BudgetRun run = run_budget({.load = 1.0, .length = seconds(3), .paths = 2});
  ASSERT_EQ(run.verdicts.size(), 4U);
  for (const BudgetVerdict& verdict : run.verdicts) {
    EXPECT_GT(verdict.packets, 100U) << verdict.what;
    EXPECT_NE(to_string(verdict).find(verdict.what), std::string::npos);
  }
  EXPECT_NE(run.verdicts[0].what.find("down"), std::string::npos);
  EXPECT_NE(run.verdicts[1].what.find("up"), std::string::npos);
  EXPECT_TRUE(run.established);
}

}  // namespace
}  // namespace pitwall::radio
