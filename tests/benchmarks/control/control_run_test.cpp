// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/control_run.hpp"

#include <gtest/gtest.h>

#include "tests/benchmarks/laps/shipped_scenario.hpp"

namespace pitwall::control_bench {
namespace {

// The plan cut after its first two speeds.
Plan short_plan(const bench::Loaded& on) {
  Plan plan = plan_of(on.scenario, 0.0);
  plan.windows.resize(2);
  plan.scenario.duration = plan.windows.back().until;
  return plan;
}

TEST(ControlRun, CountsTheTicksOfItsWindowsAlone) {
  const bench::Loaded on = laps::shipped_scenario("tms_flying_lap");
  const Plan plan = short_plan(on);
  const auto row = run_control(plan, on.setup);
  ASSERT_TRUE(row);
  EXPECT_FALSE(row->ended_early()) << row->end;
  const auto& brackets = row->cross_track.by_bracket;
  EXPECT_NEAR(static_cast<double>(brackets[9].samples), 6000.0, 100.0);
  EXPECT_NEAR(static_cast<double>(brackets[8].samples), 6000.0, 100.0);
  EXPECT_EQ(brackets[7].samples, 0U);
  EXPECT_LT(brackets[8].max_m, 1.0);
}

TEST(ControlRun, ACarThatStopsItselfEndsTheFigures) {
  const bench::Loaded on = laps::shipped_scenario("tms_flying_lap");
  Plan plan = short_plan(on);
  plan.scenario.faults = {
      {.kind = "race_heartbeat_stop", .at = seconds(70), .lasts = seconds(60), .place = "test"}};
  const auto row = run_control(plan, on.setup);
  ASSERT_TRUE(row);
  EXPECT_TRUE(row->ended_early());
  EXPECT_NE(row->end.find(" at s = "), std::string::npos);
  EXPECT_LT(row->cross_track.by_bracket[9].samples, 5000U);
}

}  // namespace
}  // namespace pitwall::control_bench
