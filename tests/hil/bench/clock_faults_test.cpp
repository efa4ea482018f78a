// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/clock_faults.hpp"

#include <gtest/gtest.h>

namespace pitwall::bench {
namespace {

using faults::BenchFaultKind;

constexpr Instant kStart = Instant{} + seconds(10);

TEST(ClockFaults, AStepIsASecondForAllSamplesWhileItLasts) {
  const ClockFaults faults{{{.kind = BenchFaultKind::kGpsTimeStep,
                             .start = kStart,
                             .duration = seconds(5),
                             .value = -1.0}}};
  EXPECT_EQ(faults.shift(kStart - nanoseconds(1)), Duration{});
  EXPECT_EQ(faults.shift(kStart), seconds(-1));
  EXPECT_EQ(faults.shift(kStart + seconds(5)), Duration{});
  world::SensorInput samples;
  ASSERT_TRUE(samples.positions.push({.at = kStart}));
  ASSERT_TRUE(samples.imu.push({.at = kStart + milliseconds(3)}));
  const world::SensorInput shifted = faults.apply(samples, kStart);
  EXPECT_EQ(shifted.positions[0].at, kStart - seconds(1));
  EXPECT_EQ(shifted.imu[0].at, kStart + milliseconds(3) - seconds(1));
  EXPECT_EQ(faults.apply(samples, kStart + seconds(6)).positions[0].at, kStart);
}

TEST(ClockFaults, AFastClockLeavesGpsTimeBehind) {
  const ClockFaults faults{{{.kind = BenchFaultKind::kClockSkew,
                             .start = kStart,
                             .duration = std::nullopt,
                             .value = 100.0}}};
  EXPECT_EQ(faults.shift(kStart), Duration{});
  EXPECT_NEAR(faults.shift(kStart + seconds(100)).seconds(), -0.01, 1e-9);
}

}  // namespace
}  // namespace pitwall::bench
