// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/step/lockstep_speed.hpp"

#include <gtest/gtest.h>

#include <string>

#include "protocol/transport/clock.hpp"

namespace pitwall::benchmarks {
namespace {

TEST(LockstepSpeed, IsProcessorTimeOfASimulatedSecond) {
  const std::string root = PITWALL_SOURCE_DIR;
  auto loaded = bench::load(root + "/" + kBenchScenario, root);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  loaded->scenario.duration = seconds(20);
  for (const bool with_log : {false, true}) {
    const Duration before = transport::thread_time();
    const auto cost = lockstep_cost(*loaded, with_log);
    const double took_us = 1e-3 * static_cast<double>((transport::thread_time() - before).ns);
    ASSERT_TRUE(cost) << to_string(cost.error());
    EXPECT_GT(cost->unit_us, 0.0);
    EXPECT_GT(cost->second_us, 0.0);
    // Forty units, each after one that is not counted, are no part of it.
    EXPECT_LT(20 * cost->second_us + 2 * 40 * cost->unit_us, took_us);
    EXPECT_DOUBLE_EQ(cost->times_real_time(), 1e6 / cost->second_us);
  }
}

// A run on a processor that was slowed down costs more time and no more units.
TEST(LockstepSpeed, TheMedianIsByUnits) {
  const LockstepCost quiet{10'000.0, 50.0}, slowed{30'000.0, 150.0}, light{9'000.0, 50.0},
      heavy{11'000.0, 50.0}, heaviest{12'000.0, 25.0};
  EXPECT_EQ(median_of({quiet}).second_us, 10'000.0);
  EXPECT_EQ(median_of({heavy, light, quiet}).second_us, 10'000.0);
  EXPECT_EQ(median_of({heaviest, light, slowed}).second_us, 30'000.0);
}

TEST(LockstepSpeed, TheGateIsFiftyTimesRealTime) {
  const LockstepCost fast{19'900.0, cost::kReferenceUnit_us}, slow{20'100.0, fast.unit_us};
  EXPECT_TRUE(lockstep_gate(fast, "").held());
  EXPECT_FALSE(lockstep_gate(slow, "").held());
  EXPECT_TRUE(lockstep_gate({2 * fast.second_us, 2 * fast.unit_us}, "").held());
}

}  // namespace
}  // namespace pitwall::benchmarks
