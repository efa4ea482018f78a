// SPDX-License-Identifier: Apache-2.0
#include "tests/real_time/stall_watch.hpp"

#include <gtest/gtest.h>

#include "protocol/transport/clock.hpp"

namespace pitwall::testing {
namespace {

// As `stalls` of two processors in a run of 100 s.
Stalls of(int count, Duration worst, Duration together, Duration stolen) {
  return {.count = count,
          .worst = worst,
          .together = together,
          .stolen = stolen,
          .watched = seconds(200)};
}

TEST(Stalls, OneThatNoBenchCanBearSpoilsARun) {
  EXPECT_FALSE(spoiled(of(1, milliseconds(40), milliseconds(40), seconds(1))));
  EXPECT_TRUE(spoiled(of(1, milliseconds(41), milliseconds(41), seconds(1))));
}

TEST(Stalls, ManySmallOnesSpoilARun) {
  EXPECT_FALSE(spoiled(of(50, milliseconds(20), milliseconds(1000), seconds(1))));
  EXPECT_TRUE(spoiled(of(51, milliseconds(20), milliseconds(1020), seconds(1))));
}

TEST(Stalls, AreTheHostsOnlyWhereItTookTheTime) {
  EXPECT_FALSE(spoiled(of(10, milliseconds(500), seconds(5), Duration{})));
  EXPECT_FALSE(spoiled(of(10, milliseconds(500), seconds(5), milliseconds(2490))));
  EXPECT_TRUE(spoiled(of(10, milliseconds(500), seconds(5), milliseconds(2500))));
}

TEST(Stalls, AMachineThatWasThereSpoilsNothing) {
  EXPECT_FALSE(spoiled(of(0, {}, {}, {})));
  EXPECT_FALSE(spoiled(of(0, {}, {}, seconds(10)))) << "often taken, never for long";
}

TEST(Stalls, SayWhatTheHostDid) {
  EXPECT_EQ(to_string(of(3, milliseconds(90), milliseconds(130), milliseconds(250))),
            "the host took 250 ms of processor time, a processor was 3 times away for more than "
            "15 ms, for 90 ms at worst, 130 ms together");
}

TEST(StallWatch, WatchesEachProcessorAllTheTime) {
  const Instant from = transport::monotonic_now();
  const StallWatch watch;
  transport::sleep_until(from + milliseconds(50));
  const Stalls seen = watch.seen();
  EXPECT_GE(seen.watched, milliseconds(45));
  EXPECT_GE(seen.stolen, Duration{});
  EXPECT_EQ(seen.count == 0, seen.worst == Duration{});
  EXPECT_LE(seen.worst, seen.together);
  EXPECT_GE(watch.last_stall(), from);
}

}  // namespace
}  // namespace pitwall::testing
