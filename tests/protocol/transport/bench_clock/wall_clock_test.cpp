// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/bench_clock/wall_clock.hpp"

#include <gtest/gtest.h>

#include "protocol/transport/clock.hpp"

namespace pitwall::transport {
namespace {

// A deadline of another clock would have passed, or never come.
TEST(WallClock, IsTheOneThatTheKernelsWaitsGoBy) {
  const Instant before = wall_now();
  sleep_until(before + milliseconds(5));
  EXPECT_GE(wall_now(), before + milliseconds(5));
  EXPECT_LT(wall_now(), before + seconds(20));
  EXPECT_LE(before, monotonic_now());
}

}  // namespace
}  // namespace pitwall::transport
