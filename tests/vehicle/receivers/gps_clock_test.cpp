// SPDX-License-Identifier: Apache-2.0
#include "vehicle/receivers/gps_clock.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace pitwall::receivers {
namespace {

constexpr gnss::GpsTime kStart = gnss::gps_time(2209, seconds(491'674));
constexpr Instant kBoot{seconds(5).ns};

constexpr Instant truth(std::int64_t ms) { return kBoot + milliseconds(ms); }

// A receiver on a car clock that began at kBoot and runs `drift_ppm` fast.
struct Source {
  GpsClock clock{Duration{}};
  Duration step{};
  std::int64_t drift_ppm = 0;

  Placed say(Stream stream, std::int64_t ms, Duration delay) {
    const Duration t = milliseconds(ms);
    const Duration gained = t * drift_ppm / 1'000'000;
    return clock.place(stream, kStart + t + step, kBoot + t + gained + delay);
  }
  // All that a receiver says from one time to another; the IMU is the quickest.
  void run(std::int64_t from_ms, std::int64_t until_ms, bool imu = true) {
    for (std::int64_t ms = from_ms; ms < until_ms; ++ms) {
      if (imu && ms % 8 == 0) say(Stream::kImu, ms, milliseconds(2));
      if (ms % 50 == 0) say(Stream::kPosition, ms, milliseconds(30));
      if (ms % 50 == 0) say(Stream::kVelocity, ms, milliseconds(35));
    }
  }
};

TEST(GpsClock, IsOffByTheSmallestDelayOnlyOnceThatWasSeen) {
  Source r;
  r.say(Stream::kImu, 0, milliseconds(2));
  for (int k = 1; k < 700; ++k) {
    const Duration delay = milliseconds(2 + (k * 37) % 50);
    EXPECT_EQ(r.say(Stream::kImu, 10 * k, delay).at, truth(10 * k) + milliseconds(2)) << k;
  }
}

TEST(GpsClock, TheDelayThatIsKnownIsTakenOut) {
  Source r{.clock = GpsClock{milliseconds(2)}};
  r.run(0, 3'000);
  EXPECT_EQ(r.say(Stream::kPosition, 3'000, milliseconds(31)).at, truth(3'000));
  EXPECT_EQ(r.say(Stream::kImu, 3'000, milliseconds(2)).at, truth(3'000));
}

TEST(GpsClock, NeverPlacesASoundStampAfterItsArrival) {
  Source r;
  for (int k = 0; k < 5'000; ++k) {
    const Duration delay = microseconds(100 + (k * 7'919) % 40'000);
    const Placed placed = r.say(Stream::kImu, 10 * k, delay);
    ASSERT_EQ(placed.flaw, StampFlaw::kNone);
    EXPECT_LE(placed.at, truth(10 * k) + delay);
  }
}

TEST(GpsClock, SpacingOfSamplesIsTheReceiversNotTheNetworks) {
  Source r;
  for (int k = 0; k < 100; ++k) r.say(Stream::kImu, 10 * k, milliseconds(3));
  // A stall: a second of samples arrives at once.
  for (int k = 100; k < 200; ++k) {
    const auto placed = r.say(Stream::kImu, 10 * k, milliseconds(3 + 10 * (200 - k)));
    EXPECT_EQ(placed.at, truth(10 * k) + milliseconds(3));
  }
}

TEST(GpsClock, ForgetsASmallDelayThatIsGoneForGood) {
  Source r;
  r.say(Stream::kImu, 0, milliseconds(1));
  Placed last;
  for (int k = 1; k < 1'900; ++k) last = r.say(Stream::kImu, 10 * k, milliseconds(9));
  EXPECT_EQ(last.at, truth(18'990) + milliseconds(9));
}

// A heading comes once a second; the one of the first second may have been the slowest of all.
TEST(GpsClock, AStreamOfFewSamplesMovesNothingWhileTheQuickestIsHeard) {
  Source r;
  for (std::int64_t ms = 0; ms < 60'000; ms += 50) {
    r.run(ms, ms + 50);
    const bool first = ms == 0;
    if (ms % 1'000 == 0) r.say(Stream::kHeading, ms, milliseconds(first ? 55 : 50 + ms % 3));
    ASSERT_EQ(r.say(Stream::kImu, ms + 49, milliseconds(2)).at, truth(ms + 49) + milliseconds(2))
        << ms;
  }
}

TEST(GpsClock, AStreamOfUnknownDelayAloneLeavesTheOffsetAsItIs) {
  Source r;
  r.run(0, 20'000);
  for (std::int64_t ms = 20'000; ms < 60'000; ms += 1'000)
    EXPECT_EQ(r.say(Stream::kAttitude, ms, milliseconds(50)).at, truth(ms) + milliseconds(2)) << ms;
}

// 5 ms of delay that come or go along the way are no step of the car.
TEST(GpsClock, AnOffsetThatGrowsALittleGrowsSlowly) {
  Source r;
  Duration before{}, most{};
  for (std::int64_t ms = 0; ms < 60'000; ms += 10) {
    const Placed placed = r.say(Stream::kImu, ms, milliseconds(ms < 10'000 ? 2 : 6));
    const Duration off = placed.at - truth(ms);
    if (ms > 0) most = std::max(most, off - before);
    before = off;
  }
  EXPECT_EQ(before, milliseconds(6));
  EXPECT_LE(most, milliseconds(10) * GpsClock::kSlewPerMillion / 1'000'000);
}

// The position takes 28 ms longer than the IMU: at 70 m/s that is two metres.
TEST(GpsClock, StaysWhereItWasWhenTheQuickestStreamFallsSilent) {
  for (const std::int64_t drift_ppm : {0, 50, -50, 200}) {
    Source r{.drift_ppm = drift_ppm};
    r.run(0, 20'000);
    r.run(20'000, 80'000, false);
    const Placed placed = r.say(Stream::kPosition, 80'000, milliseconds(33));
    const Duration gained = milliseconds(80'000) * drift_ppm / 1'000'000;
    const Duration off = placed.at - (truth(80'000) + gained + milliseconds(2));
    EXPECT_LT(std::abs(off.ns), seconds(16).ns * (std::abs(drift_ppm) + 1) / 1'000'000) << off.ns;
  }
}

TEST(GpsClock, FollowsAClockThatRunsFastOrSlow) {
  for (const std::int64_t drift_ppm : {-500, -50, 50, 500}) {
    Source r{.drift_ppm = drift_ppm};
    for (std::int64_t ms = 0; ms < 600'000; ms += 50) {
      r.run(ms, ms + 50);
      const Duration gained = milliseconds(ms) * drift_ppm / 1'000'000;
      const Placed placed = r.say(Stream::kHeading, ms, milliseconds(40));
      const Duration off = placed.at - (truth(ms) + gained + milliseconds(2));
      ASSERT_LE(std::abs(off.ns), seconds(16).ns * std::abs(drift_ppm) / 1'000'000) << ms;
    }
  }
}

TEST(GpsClock, AFrozenStampStaysWhereItIsAndIsEvidenceOfNothing) {
  Source r;
  r.run(0, 5'000);
  const Placed first = r.say(Stream::kHeading, 5'000, milliseconds(40));
  EXPECT_EQ(first.flaw, StampFlaw::kNone);
  for (int k = 1; k < 600; ++k) {  // all streams stand still, longer than the window
    const auto again = r.clock.place(Stream::kHeading, kStart + milliseconds(5'000),
                                     kBoot + milliseconds(5'000 + 50 * k));
    EXPECT_EQ(again.flaw, StampFlaw::kFrozen);
    EXPECT_EQ(again.at, first.at);
  }
}

TEST(GpsClock, AStampThatRunsBackIsToldAndPlacedBack) {
  Source r;
  r.run(0, 5'000);
  const Placed back = r.say(Stream::kPosition, 4'000, milliseconds(1'030));
  EXPECT_EQ(back.flaw, StampFlaw::kBack);
  EXPECT_EQ(back.at, truth(4'000) + milliseconds(2));
  EXPECT_EQ(r.say(Stream::kImu, 5'000, milliseconds(3)).at, truth(5'000) + milliseconds(2));
}

TEST(GpsClock, OneSampleFromTheFutureLiesInTheFutureAndSpoilsNothing) {
  Source r;
  r.run(0, 5'000);
  for (const Duration ahead : {milliseconds(100), seconds(1), seconds(604'800)}) {
    r.step = ahead;
    const Placed placed = r.say(Stream::kHeading, 5'000, milliseconds(30));
    EXPECT_EQ(placed.flaw, StampFlaw::kFuture);
    EXPECT_EQ(placed.at, truth(5'000) + ahead + milliseconds(2));
    r.step = {};
    EXPECT_EQ(r.say(Stream::kImu, 5'000, milliseconds(2)).at, truth(5'000) + milliseconds(2));
  }
  EXPECT_EQ(r.clock.steps(), 0U);
}

// However long it lasts: the others contradict it.
TEST(GpsClock, OneStreamFromTheFutureIsNotBelieved) {
  Source r;
  r.run(0, 5'000);
  for (std::int64_t ms = 5'000; ms < 60'000; ms += 50) {
    for (std::int64_t imu = ms; imu < ms + 50; imu += 8) {
      const Placed placed = r.say(Stream::kImu, imu, milliseconds(2));
      ASSERT_EQ(placed.at, truth(imu) + milliseconds(2)) << imu;
    }
    r.step = milliseconds(400);
    ASSERT_EQ(r.say(Stream::kPosition, ms, milliseconds(30)).flaw, StampFlaw::kFuture) << ms;
    r.step = {};
  }
}

TEST(GpsClock, AStepOfTheReceiversTimeIsBelievedWhenConfirmed) {
  Source r;
  r.run(0, 5'000);
  r.step = seconds(18);
  for (int k = 0; k < GpsClock::kConfirmations - 1; ++k)
    EXPECT_EQ(r.say(Stream::kImu, 5'000 + 10 * k, milliseconds(2)).flaw, StampFlaw::kFuture);
  const Placed believed = r.say(Stream::kImu, 5'050, milliseconds(2));
  EXPECT_EQ(believed.flaw, StampFlaw::kNone);
  EXPECT_EQ(believed.at, truth(5'050) + milliseconds(2));
  EXPECT_EQ(r.clock.steps(), 1U);
}

TEST(GpsClock, StartsAfreshAfterALongSilence) {
  Source r;
  r.say(Stream::kImu, 0, milliseconds(1));
  EXPECT_EQ(r.say(Stream::kImu, 100'000, milliseconds(30)).at, truth(100'000) + milliseconds(30));
}

}  // namespace
}  // namespace pitwall::receivers
