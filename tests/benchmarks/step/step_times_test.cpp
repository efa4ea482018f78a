// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/step/step_times.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/benchmarks/step/lockstep_speed.hpp"

namespace pitwall::benchmarks {
namespace {

TEST(StepTimes, AreOneForEachTickWhateverTheRuns) {
  const std::string root = PITWALL_SOURCE_DIR;
  auto loaded = bench::load(root + "/" + kBenchScenario, root);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  loaded->scenario.duration = seconds(4);
  const auto times = time_steps(*loaded);
  ASSERT_TRUE(times) << to_string(times.error());
  EXPECT_EQ(times->steps.size(), 401u);
  EXPECT_EQ(times->allocations, 0u);
  EXPECT_GT(times->unit_us, 0.0);
  for (const StepTime& step : times->steps) EXPECT_GT(step.least_us, 0.0);
  // Positions and velocities come some ticks after they were true.
  const auto late = std::count_if(times->steps.begin(), times->steps.end(),
                                  [](const StepTime& step) { return step.rewind.has_value(); });
  EXPECT_GT(late, 50);
  EXPECT_LT(late, 400);
}

}  // namespace
}  // namespace pitwall::benchmarks
