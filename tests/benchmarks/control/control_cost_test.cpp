// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/control_cost.hpp"

#include <gtest/gtest.h>

#include "tests/benchmarks/laps/shipped_scenario.hpp"

namespace pitwall::control_bench {
namespace {

const std::vector<std::string> kBoth{"paper_lqr", "feed_forward"};

bench::Loaded seconds_of_a_lap() {
  bench::Loaded loaded = laps::shipped_scenario("lvms_flying_lap");
  loaded.scenario.duration = seconds(12);
  return loaded;
}

// How long it takes is the machine's; that all was measured, and that nothing allocates, is not.
TEST(ControlCost, MeasuresEachLawWithTheInputsOfADrive) {
  const auto cost = measure_cost(seconds_of_a_lap(), kBoth);
  ASSERT_TRUE(cost) << to_string(cost.error());
  EXPECT_GT(cost->ticks, 500U);
  EXPECT_GT(cost->profile_points, 1000U);
  EXPECT_EQ(cost->allocations, 0U);
  ASSERT_EQ(cost->laws.size(), 2U);
  for (const LawCost& law : cost->laws) {
    EXPECT_GT(law.tick_p99_us, 0.0);
    EXPECT_GT(cost->prepare_us, law.tick_p99_us);
  }
  EXPECT_NE(to_text(*cost).find("feed_forward"), std::string::npos);
}

TEST(ControlCost, AGateForEachFigure) {
  const ControlCost good{.laws = {{"ours", 19.0}},
                         .ticks = 1000,
                         .profile_points = 1200,
                         .prepare_us = 990.0,
                         .profile_us = 1990.0,
                         .unit_us = cost::kReferenceUnit_us};
  EXPECT_TRUE(gates_of(good).held());
  for (const auto spoil :
       {+[](ControlCost& c) { c.laws[0].tick_p99_us = 21.0; },
        +[](ControlCost& c) { c.prepare_us = 1010.0; },
        +[](ControlCost& c) { c.profile_us = 2010.0; }, +[](ControlCost& c) { c.allocations = 1; },
        +[](ControlCost& c) { c.ticks = 0; }}) {
    ControlCost bad = good;
    spoil(bad);
    EXPECT_FALSE(gates_of(bad).held());
  }
}

TEST(ControlCost, AParameterThatControlRefusesIsToldWithItsName) {
  bench::Loaded loaded = seconds_of_a_lap();
  loaded.scenario.duration = seconds(1);
  loaded.setup.params.control.lateral.angle_max_rad = 9.0;
  const auto cost = measure_cost(loaded, kBoth);
  ASSERT_FALSE(cost);
  EXPECT_EQ(cost.error().place, "lateral.angle_max_rad");
}

}  // namespace
}  // namespace pitwall::control_bench
