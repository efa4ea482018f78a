// SPDX-License-Identifier: Apache-2.0
#include "basestation/link/packet_rate.hpp"

#include <gtest/gtest.h>

namespace pitwall::link {
namespace {

constexpr Instant kStart{seconds(9).ns};

TEST(PacketRate, CountsTheLastSecond) {
  PacketRate rate;
  for (int i = 0; i < 500; ++i) rate.note(kStart + milliseconds(20 * i));
  const Instant last = kStart + milliseconds(20 * 499);
  EXPECT_EQ(rate.rate_hz(last), 50.0);
  EXPECT_EQ(rate.rate_hz(last + milliseconds(500)), 25.0);
  EXPECT_EQ(rate.rate_hz(last + seconds(2)), 0.0);
  EXPECT_NEAR(rate.mean_rate_hz(), 50.0, 1e-9);
}

TEST(PacketRate, ACarIsLostASecondAfterItsLastPacket) {
  PacketRate rate;
  EXPECT_FALSE(rate.lost(kStart)) << "a car that was never received is not lost";
  rate.note(kStart);
  EXPECT_FALSE(rate.lost(kStart + PacketRate::kLostAfter));
  EXPECT_TRUE(rate.lost(kStart + PacketRate::kLostAfter + nanoseconds(1)));
  EXPECT_EQ(rate.mean_rate_hz(), 0.0);
}

}  // namespace
}  // namespace pitwall::link
