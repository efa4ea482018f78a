// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/gps_clock.hpp"

#include <gtest/gtest.h>

namespace pitwall::io {
namespace {

constexpr gnss::GpsTime kStart = gnss::gps_time(2209, seconds(491'674));
constexpr Instant kBoot{seconds(5).ns};

// A receiver whose k-th sample of 100 Hz arrives `delay` late on a car clock that began at kBoot.
struct Receiver {
  GpsClock clock;
  Duration step{};

  std::optional<Instant> sample(int k, Duration delay) {
    const Duration t = milliseconds(10) * k;
    return clock.place(kStart + t + step, kBoot + t + delay);
  }
};

constexpr Instant truth(int k) { return kBoot + milliseconds(10) * k; }

TEST(GpsClock, IsOffByTheSmallestDelayOnlyOnceThatWasSeen) {
  Receiver r;
  r.sample(0, milliseconds(2));
  for (int k = 1; k < 700; ++k) {
    const Duration delay = milliseconds(2 + (k * 37) % 50);
    EXPECT_EQ(r.sample(k, delay).value(), truth(k) + milliseconds(2)) << k;
  }
}

TEST(GpsClock, NeverPlacesASampleAfterItsArrival) {
  Receiver r;
  for (int k = 0; k < 5'000; ++k) {
    const Duration delay = microseconds(100 + (k * 7'919) % 40'000);
    const auto at = r.sample(k, delay);
    ASSERT_TRUE(at.has_value());
    EXPECT_LE(*at, truth(k) + delay);
  }
}

TEST(GpsClock, SpacingOfSamplesIsTheReceiversNotTheNetworks) {
  Receiver r;
  for (int k = 0; k < 100; ++k) r.sample(k, milliseconds(3));
  // A stall: a second of samples arrives at once.
  for (int k = 100; k < 200; ++k) {
    const auto at = r.sample(k, milliseconds(3 + 10 * (200 - k)));
    EXPECT_EQ(at.value(), truth(k) + milliseconds(3));
  }
}

TEST(GpsClock, ForgetsASmallDelayThatIsGoneForGood) {
  Receiver r;
  r.sample(0, milliseconds(1));
  std::optional<Instant> last;
  for (int k = 1; k < 1'700; ++k) last = r.sample(k, milliseconds(9));
  EXPECT_EQ(*last, truth(1'699) + milliseconds(9));
}

TEST(GpsClock, OneSampleFromTheFutureIsDroppedAndSpoilsNothing) {
  Receiver r;
  for (int k = 0; k < 50; ++k) r.sample(k, milliseconds(2));
  r.step = seconds(604'800);
  EXPECT_FALSE(r.sample(50, milliseconds(2)).has_value());
  r.step = {};
  EXPECT_EQ(r.sample(51, milliseconds(2)).value(), truth(51) + milliseconds(2));
  EXPECT_EQ(r.clock.steps(), 0U);
}

TEST(GpsClock, AStepOfTheReceiversTimeIsBelievedWhenConfirmed) {
  Receiver r;
  for (int k = 0; k < 50; ++k) r.sample(k, milliseconds(2));
  r.step = seconds(18);
  for (int k = 50; k < 50 + GpsClock::kConfirmations - 1; ++k) {
    EXPECT_FALSE(r.sample(k, milliseconds(2)).has_value());
  }
  EXPECT_EQ(r.sample(60, milliseconds(2)).value(), truth(60) + milliseconds(2));
  EXPECT_EQ(r.clock.steps(), 1U);
}

TEST(GpsClock, StartsAfreshAfterALongSilence) {
  Receiver r;
  r.sample(0, milliseconds(1));
  EXPECT_EQ(r.sample(10'000, milliseconds(30)).value(), truth(10'000) + milliseconds(30));
}

}  // namespace
}  // namespace pitwall::io
