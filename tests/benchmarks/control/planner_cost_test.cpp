// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/planner_cost.hpp"

#include <gtest/gtest.h>

#include "tests/benchmarks/laps/shipped_scenario.hpp"

namespace pitwall::control_bench {
namespace {

// How long it takes is the machine's; that all was measured, and that nothing allocates, is not.
TEST(PlannerCost, MeasuresWithTheInputsOfAMatch) {
  bench::Loaded loaded = laps::shipped_scenario("matches/match_won");
  loaded.scenario.duration = seconds(15);
  const auto cost = measure_planner(loaded);
  ASSERT_TRUE(cost) << to_string(cost.error());
  EXPECT_GT(cost->ticks, 200U);
  EXPECT_EQ(cost->passing, 0U);
  EXPECT_EQ(cost->allocations, 0U);
  EXPECT_GT(cost->tick_p99_us, 0.0);
  EXPECT_NE(to_text(*cost).find("ticks of a match"), std::string::npos);
}

TEST(PlannerCost, AGateForEachFigure) {
  const PlannerCost good{
      .ticks = 1000, .passing = 100, .tick_p99_us = 990.0, .unit_us = cost::kReferenceUnit_us};
  EXPECT_TRUE(gates_of(good).held());
  for (const auto spoil :
       {+[](PlannerCost& c) { c.tick_p99_us = 1010.0; }, +[](PlannerCost& c) { c.allocations = 1; },
        +[](PlannerCost& c) { c.passing = 0; }}) {
    PlannerCost bad = good;
    spoil(bad);
    EXPECT_FALSE(gates_of(bad).held());
  }
}

}  // namespace
}  // namespace pitwall::control_bench
