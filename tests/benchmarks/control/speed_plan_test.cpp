// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/speed_plan.hpp"

#include <gtest/gtest.h>

#include "protocol/vocabulary/units.hpp"
#include "tests/benchmarks/laps/shipped_scenario.hpp"

namespace pitwall::speed_bench {
namespace {

TEST(SpeedPlan, StepsFromThirtyToFortyAndHoldsEachSpeed) {
  const bench::Loaded on = laps::shipped_scenario("lvms_flying_lap");
  const Plan plan = plan_of(on.scenario, on.setup.params.planning);
  constexpr double kWholeMph = 0.5 * from_mph(1.0);
  EXPECT_NEAR(plan.holds[plan.step - 1].speed_mps, 30.0, kWholeMph);
  EXPECT_NEAR(plan.holds[plan.step].speed_mps, 40.0, kWholeMph);
  std::size_t slower = 0;
  for (std::size_t i = 0; i < plan.holds.size(); ++i) {
    const Hold& hold = plan.holds[i];
    EXPECT_GE((hold.until - hold.steady_from).seconds(), 15.0);
    EXPECT_GT(hold.steady_from.ns, hold.from.ns);
    if (i == 0) continue;
    EXPECT_EQ(hold.from.ns, plan.holds[i - 1].until.ns);
    slower += hold.speed_mps < plan.holds[i - 1].speed_mps ? 1U : 0U;
  }
  EXPECT_EQ(plan.slow_downs, slower);
  EXPECT_EQ(plan.scenario.duration.ns, plan.holds.back().until.ns);
}

TEST(SpeedPlan, ThreeCarsAreDriven) {
  EXPECT_EQ(cars().size(), 3U);
  for (const control_bench::World& car : cars())
    EXPECT_TRUE(car.name == laps::kNominal || !car.plant_file.empty()) << car.name;
}

}  // namespace
}  // namespace pitwall::speed_bench
