// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/reply_limiter.hpp"

#include <gtest/gtest.h>

namespace pitwall::telemetry {
namespace {

UdpAddress source(std::uint32_t n) { return {.ip = n, .port = 1}; }

TEST(Allowance, GivesItsRateAndNoMoreAtOnce) {
  Allowance allowance(20);
  int given = 0;
  Instant now{seconds(5).ns};
  for (int ms = 0; ms < 10'000; ++ms, now += milliseconds(1)) {
    const bool has = allowance.has(now);
    const bool taken = allowance.take(now);
    EXPECT_EQ(has, taken);
    given += taken ? 1 : 0;
  }
  EXPECT_GE(given, 200);
  EXPECT_LE(given, 220);
}

TEST(ReplyLimiter, OneSourceHasItsShareAndLeavesTheRestToOthers) {
  ReplyLimiter limiter(4, 10);
  const Instant now{seconds(5).ns};
  int loud = 0;
  for (int i = 0; i < 1'000; ++i) loud += limiter.take(source(1), now) ? 1 : 0;
  EXPECT_EQ(loud, 4);
  EXPECT_TRUE(limiter.take(source(2), now));
}

TEST(ReplyLimiter, ManySourcesHaveTheWholeRateTogether) {
  ReplyLimiter limiter(4, 10);
  int given = 0;
  Instant now{seconds(5).ns};
  for (std::uint32_t i = 0; i < 100'000; ++i, now += microseconds(100)) {
    given += limiter.take(source(i % 1'000), now) ? 1 : 0;
  }
  EXPECT_GE(given, 100);
  EXPECT_LE(given, 110);
}

}  // namespace
}  // namespace pitwall::telemetry
