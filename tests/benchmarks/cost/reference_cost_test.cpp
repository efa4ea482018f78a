// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/cost/reference_cost.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "protocol/transport/clock.hpp"

namespace pitwall::cost {
namespace {

TEST(ReferenceCost, IsUnsetUntilAUnitWasTaken) {
  const ReferenceCost none;
  EXPECT_EQ(none.count(), 0u);
  EXPECT_EQ(none.unit_us(), 0.0);
  EXPECT_EQ(none.spent(), Duration{});
}

TEST(ReferenceCost, AllThatWasSpentIsTold) {
  ReferenceCost reference;
  const Duration before = transport::thread_time();
  for (int i = 0; i < 50; ++i) reference.take();
  const Duration took = transport::thread_time() - before;
  EXPECT_EQ(reference.count(), 50u);
  EXPECT_LE(reference.spent(), took);
  EXPECT_GT(reference.spent(), Duration{took.ns * 9 / 10});
  // Two units each time, the first to warm up.
  EXPECT_GT(microseconds_of(reference.spent()), 1.5 * 50 * reference.unit_us());
}

TEST(ReferenceCost, OfAMomentThatComesAgainTheLeastCounts) {
  ReferenceCost reference;
  reference.take();
  for (int i = 0; i < 200; ++i) {
    const double least_us = reference.unit_us();
    reference.again();
    const double taken_us = reference.take();
    EXPECT_EQ(reference.unit_us(), std::min(least_us, taken_us));
    EXPECT_EQ(reference.count(), 1u);
  }
}

}  // namespace
}  // namespace pitwall::cost
