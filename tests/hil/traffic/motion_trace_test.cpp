// SPDX-License-Identifier: Apache-2.0
#include "hil/traffic/motion_trace.hpp"

#include <gtest/gtest.h>

#include <type_traits>

namespace pitwall::traffic {
namespace {

static_assert(std::is_trivially_copyable_v<MotionTrace>);

TEST(MotionTrace, KeepsTheNewestSamplesAndReachesBackItsSpan) {
  MotionTrace trace;
  EXPECT_EQ(trace.size(), 0u);
  for (int ms = 0; ms <= 5'000; ms += 10)
    trace.record({.vx_mps = 3.0, .vy_mps = 4.0, .n_m = 0.001 * ms}, Instant{} + milliseconds(ms));
  EXPECT_EQ(trace.sample(0).at, Instant{} + seconds(5));
  EXPECT_EQ(trace.sample(0).speed_mps, 5.0);
  for (std::size_t i = 1; i < trace.size(); ++i) {
    EXPECT_EQ(trace.sample(i - 1).at - trace.sample(i).at, kTraceStep);
    EXPECT_DOUBLE_EQ(trace.sample(i).n_m, trace.sample(i).at.seconds());
  }
  EXPECT_GE(trace.sample(0).at - trace.sample(trace.size() - 1).at, kTraceSpan);
}

}  // namespace
}  // namespace pitwall::traffic
