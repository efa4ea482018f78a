// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/checks/stamp_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::localization {
namespace {

Instant at_ms(std::int64_t ms) { return Instant{1'000'000'000 + ms * 1'000'000}; }

TEST(StampWatch, KnowsNothingBeforeTheFirst) {
  const StampWatch watch;
  EXPECT_TRUE(std::isinf(watch.spacing_s(at_ms(0))));
  EXPECT_TRUE(std::isinf(watch.after_newest_s(at_ms(0))));
}

TEST(StampWatch, AStampThatWasUsedHasNoSpacingWheneverItComesBack) {
  StampWatch watch;
  for (int i = 0; i < 10; ++i) watch.use(at_ms(50 * i));
  for (int i = 0; i < 10; ++i) EXPECT_EQ(watch.spacing_s(at_ms(50 * i)), 0.0) << i;
  EXPECT_NEAR(watch.spacing_s(at_ms(75)), 0.025, 1e-12);
  EXPECT_NEAR(watch.spacing_s(at_ms(500)), 0.050, 1e-12);
}

// Datagrams that change places: the order in which stamps were used changes nothing.
TEST(StampWatch, TheOrderOfUseDoesNotMatter) {
  StampWatch forward, backward;
  for (int i = 0; i < 8; ++i) {
    forward.use(at_ms(50 * i));
    backward.use(at_ms(50 * (7 - i)));
  }
  for (int ms = -100; ms < 500; ms += 7) {
    EXPECT_EQ(forward.spacing_s(at_ms(ms)), backward.spacing_s(at_ms(ms))) << ms;
    EXPECT_EQ(forward.after_newest_s(at_ms(ms)), backward.after_newest_s(at_ms(ms))) << ms;
  }
}

TEST(StampWatch, AStampBeforeTheNewestIsSoFarBack) {
  StampWatch watch;
  watch.use(at_ms(100));
  watch.use(at_ms(40));
  EXPECT_NEAR(watch.after_newest_s(at_ms(85)), -0.015, 1e-12);
  EXPECT_NEAR(watch.after_newest_s(at_ms(150)), 0.050, 1e-12);
}

TEST(StampWatch, HoldsTheLastOnes) {
  StampWatch watch;
  for (int i = 0; i < 100; ++i) watch.use(at_ms(10 * i));
  EXPECT_EQ(watch.size, kStampsKept);
  EXPECT_EQ(watch.spacing_s(at_ms(990)), 0.0);
  EXPECT_GT(watch.spacing_s(at_ms(0)), 0.5);
}

}  // namespace
}  // namespace pitwall::localization
