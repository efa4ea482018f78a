// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/control_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/benchmarks/laps/shipped_scenario.hpp"

namespace pitwall::control_bench {
namespace {

TEST(ControlPlan, HoldsEachBracketForALapAndAMinute) {
  for (const char* name : {"lvms_flying_lap", "ims_flying_lap", "tms_flying_lap"}) {
    const bench::Loaded on = laps::shipped_scenario(name);
    const double length_m = on.setup.track.length_m();
    const Plan plan = plan_of(on.scenario, length_m);
    std::set<std::size_t> brackets;
    double last_mps = 0.0;
    for (const Window& w : plan.windows) {
      const grading::Bracket& b = grading::kBrackets[w.bracket];
      EXPECT_GT(w.speed_mps, b.from_mps);
      EXPECT_LT(w.speed_mps, b.to_mps);
      EXPECT_GT(w.speed_mps, last_mps) << "slowest first";
      EXPECT_GE((w.until - w.from).seconds(), 60.0);
      EXPECT_GE((w.until - w.from).seconds() * w.speed_mps, length_m - 0.01);
      brackets.insert(w.bracket);
      last_mps = w.speed_mps;
    }
    EXPECT_EQ(brackets.size(), grading::kBrackets.size());
    EXPECT_GT(plan.scenario.duration.ns, plan.windows.back().until.ns);
    EXPECT_TRUE(std::ranges::is_sorted(plan.scenario.race_control, {},
                                       [](const auto& change) { return change.at.ns; }));
  }
}

TEST(ControlPlan, TheNominalWorldIsFirstAndEachIsAnother) {
  const std::vector<World> all = worlds();
  EXPECT_EQ(all.front().name, laps::kNominal);
  std::set<std::string> names;
  for (const World& world : all) names.insert(world.name);
  EXPECT_EQ(names.size(), all.size());
  EXPECT_EQ(all.size(), laps::cases().size() + 2);
}

TEST(ControlPlan, CarsOfTheFamilyArePrintedAndNotJudged) {
  const std::vector<World> cars = family_worlds(2);
  ASSERT_EQ(cars.size(), 2U);
  EXPECT_NE(cars[0].name, cars[1].name);
  EXPECT_NE(cars[0].plant->chassis.mass_kg, cars[1].plant->chassis.mass_kg);
  for (const World& car : cars) EXPECT_FALSE(car.is_judged());
  for (const World& world : worlds()) EXPECT_TRUE(world.is_judged());
}

}  // namespace
}  // namespace pitwall::control_bench
