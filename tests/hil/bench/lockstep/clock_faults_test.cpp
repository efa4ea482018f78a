// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/lockstep/clock_faults.hpp"

#include <gtest/gtest.h>

namespace pitwall::bench {
namespace {

using faults::BenchFaultKind;

constexpr Instant kFaultStart = Instant{} + seconds(10);

TEST(ClockFaults, AStepIsASecondForAllSamplesWhileItLasts) {
  const ClockFaults faults{{{.kind = BenchFaultKind::kGpsTimeStep,
                             .start = kFaultStart,
                             .duration = seconds(5),
                             .value = -1.0}}};
  EXPECT_EQ(faults.shift(kFaultStart - nanoseconds(1)), Duration{});
  EXPECT_EQ(faults.shift(kFaultStart), seconds(-1));
  EXPECT_EQ(faults.shift(kFaultStart + seconds(5)), Duration{});
  world::SensorInput samples;
  ASSERT_TRUE(samples.positions.push({.at = kFaultStart}));
  ASSERT_TRUE(samples.imu.push({.at = kFaultStart + milliseconds(3)}));
  const world::SensorInput shifted = faults.apply(samples, kFaultStart);
  EXPECT_EQ(shifted.positions[0].at, kFaultStart - seconds(1));
  EXPECT_EQ(shifted.imu[0].at, kFaultStart + milliseconds(3) - seconds(1));
  EXPECT_EQ(faults.apply(samples, kFaultStart + seconds(6)).positions[0].at, kFaultStart);
}

TEST(ClockFaults, AFastClockLeavesGpsTimeBehind) {
  const ClockFaults faults{{{.kind = BenchFaultKind::kClockSkew,
                             .start = kFaultStart,
                             .duration = std::nullopt,
                             .value = 100.0}}};
  EXPECT_EQ(faults.shift(kFaultStart), Duration{});
  EXPECT_NEAR(faults.shift(kFaultStart + seconds(100)).seconds(), -0.01, 1e-9);
}

}  // namespace
}  // namespace pitwall::bench
