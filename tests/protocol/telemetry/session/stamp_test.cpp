// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/stamp.hpp"

#include <gtest/gtest.h>

#include <random>

namespace pitwall::telemetry {
namespace {

TEST(StampClock, CountsNanosecondsSince1970AndNeverStandsStill) {
  StampClock clock(seconds(1'000));
  EXPECT_EQ(clock.next(Instant{seconds(5).ns}), static_cast<Stamp>(seconds(1'005).ns));
  EXPECT_EQ(clock.next(Instant{seconds(5).ns}), static_cast<Stamp>(seconds(1'005).ns) + 1);
  EXPECT_EQ(clock.next(Instant{seconds(6).ns}), static_cast<Stamp>(seconds(1'006).ns));
}

TEST(StampClock, AClockBefore1970StillCountsUp) {
  StampClock clock(seconds(-1'000));
  const Stamp first = clock.next(Instant{});
  EXPECT_EQ(first, 1U);
  EXPECT_GT(clock.next(Instant{}), first);
}

TEST(StampClock, ExceedsWhatItWasToldAndForgetsNothingGreater) {
  StampClock clock({});
  clock.exceed(1'000);
  EXPECT_EQ(clock.next(Instant{10}), 1'001U);
  clock.exceed(5);
  EXPECT_EQ(clock.next(Instant{10}), 1'002U);
  EXPECT_EQ(clock.next(Instant{2'000}), 2'000U);
}

// A thousand recorded openings, again and again, at any distance: they are recognised from the
// second round on, and what nobody has seen is new each time.
TEST(StaleStamps, KnowsAThousandRecordedStamps) {
  std::mt19937_64 random(7);
  for (const std::uint64_t distance_ms : {1U, 10U, 20U, 100U, 110U, 1'000U}) {
    StaleStamps stale;
    int taken_for_new = 0;
    for (int round = 0; round < 100; ++round) {
      for (std::uint64_t i = 0; i < 1'000; ++i) {
        const Stamp stamp = 1'700'000'000'000'000'000 + i * distance_ms * 1'000'000;
        taken_for_new += stale.is_new(stamp) ? 1 : 0;
      }
      EXPECT_TRUE(stale.is_new(random() >> 4U));
    }
    EXPECT_EQ(taken_for_new, 1'000) << distance_ms;
  }
}

}  // namespace
}  // namespace pitwall::telemetry
