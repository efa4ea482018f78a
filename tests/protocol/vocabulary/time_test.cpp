// SPDX-License-Identifier: Apache-2.0
#include "protocol/vocabulary/time.hpp"

#include <gtest/gtest.h>

namespace pitwall {
namespace {

static_assert(Instant{5} - Instant{2} == Duration{3});
static_assert(milliseconds(10) * 100 == seconds(1));
static_assert(seconds(1) / milliseconds(10) == 100);

TEST(Duration, FromSecondsRoundsToTheNearestNanosecondOnBothSidesOfZero) {
  EXPECT_EQ(from_seconds(0.01), milliseconds(10));
  EXPECT_EQ(from_seconds(-0.01), milliseconds(-10));
  EXPECT_EQ(from_seconds(1e-9), nanoseconds(1));
  for (std::int64_t n = -1000; n <= 1000; n += 7)
    EXPECT_EQ(from_seconds(microseconds(n).seconds()), microseconds(n)) << n;
}

TEST(Instant, DifferencesUndoAdditions) {
  for (std::int64_t base : {0LL, 1LL, 123'456'789'012LL}) {
    for (std::int64_t step : {-7LL, 0LL, 9'999'999LL}) {
      Instant moved{base};
      moved += Duration{step};
      EXPECT_EQ(moved - Instant{base}, Duration{step});
      EXPECT_EQ(moved - Duration{step}, Instant{base});
    }
  }
}

}  // namespace
}  // namespace pitwall
