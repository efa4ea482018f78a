// A short cut of `./pitwall bench time_trial`: one seed.
// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/time_trial/trial_run.hpp"

#include <gtest/gtest.h>

#include "tests/benchmarks/laps/shipped_scenario.hpp"
#include "tests/benchmarks/time_trial/trial_plan.hpp"
#include "tests/benchmarks/time_trial/trial_table.hpp"

namespace pitwall::time_trial {
namespace {

bench::Loaded trial(std::size_t change) {
  auto made = trial_of(laps::shipped_scenario("lvms_flying_lap"), changes()[change], 1);
  EXPECT_TRUE(made);
  return *std::move(made);
}

TEST(TrialRun, TenLapsOfLasVegasHoldTheGates) {
  const bench::Loaded free = trial(0);
  auto row = run_trial(free.scenario, free.setup);
  ASSERT_TRUE(row);
  row->name = changes()[0].name;
  EXPECT_TRUE(row->is_clean());
  EXPECT_LT(row->best_s, row->worst_s);
  // No faster than the plan, give or take what the modelled engine has beyond the known one.
  EXPECT_GT(row->best_s, 0.98 * row->planned_s);
  const Gates gates = gates_of({*row});
  EXPECT_TRUE(gates.held()) << to_text({*row});
}

// The mean is that of the laps, in the time between the crossings.
TEST(TrialRun, ARunThatIsCutShortIsNotClean) {
  bench::Loaded short_one = trial(1);
  short_one.scenario.duration = seconds(120);
  const auto row = run_trial(short_one.scenario, short_one.setup);
  ASSERT_TRUE(row);
  EXPECT_GT(row->laps, 0u);
  EXPECT_LT(row->laps, kLaps);
  EXPECT_FALSE(row->is_clean());
  EXPECT_GE(row->mean_mps, short_one.setup.track.length_m() / row->worst_s - 1e-9);
  EXPECT_LE(row->mean_mps, short_one.setup.track.length_m() / row->best_s + 1e-9);
}

TEST(TrialRun, ACarWithoutGripIsNotClean) {
  bench::Loaded slippery = trial(1);
  slippery.scenario.perturb.friction = 0.65;
  slippery.scenario.duration = seconds(120);
  const auto row = run_trial(slippery.scenario, slippery.setup);
  ASSERT_TRUE(row);
  EXPECT_FALSE(row->is_clean());
  EXPECT_TRUE(row->contact || row->spun() || row->stopped);
}

}  // namespace
}  // namespace pitwall::time_trial
