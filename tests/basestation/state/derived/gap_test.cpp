// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/gap.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/basestation/state/derived/lap.hpp"

namespace pitwall::state {
namespace {

Gaps to(double station_m, double own_m = 1'000.0) {
  const std::array others{Runner{station_m, 50.0}};
  return gaps_of({own_m, 60.0}, others, kLap_m);
}

TEST(Gap, IsBumperToBumperAndKnowsWhoComesCloser) {
  const Gaps ahead = to(1'050.0);
  EXPECT_NEAR(ahead.ahead.metres, 50.0 - kCarLength_m, 1e-9);
  EXPECT_EQ(ahead.ahead.closing_mps, 10.0);
  EXPECT_TRUE(std::isnan(ahead.behind.metres));
  const Gaps behind = to(960.0);
  EXPECT_NEAR(behind.behind.metres, 40.0 - kCarLength_m, 1e-9);
  EXPECT_EQ(behind.behind.closing_mps, -10.0);
  EXPECT_TRUE(std::isnan(behind.ahead.metres));
}

TEST(Gap, GoesAcrossTheStartLineTheShortWay) {
  EXPECT_NEAR(to(10.0, 2'390.0).ahead.metres, 20.0 - kCarLength_m, 1e-9);
  EXPECT_NEAR(to(2'390.0, 10.0).behind.metres, 20.0 - kCarLength_m, 1e-9);
}

TEST(Gap, CarsSideBySideHaveNone) {
  for (const double beside : {998.0, 1'000.0, 1'003.0}) {
    EXPECT_EQ(to(beside).ahead.metres, 0.0);
    EXPECT_EQ(to(beside).behind.metres, 0.0);
  }
}

TEST(Gap, TheNearestOfSeveralCounts) {
  const std::array others{Runner{1'300.0, 70.0}, Runner{}, Runner{1'100.0, 55.0},
                          Runner{800.0, 50.0}};
  const Gaps gaps = gaps_of({1'000.0, 60.0}, others, kLap_m);
  EXPECT_NEAR(gaps.ahead.metres, 100.0 - kCarLength_m, 1e-9);
  EXPECT_EQ(gaps.ahead.closing_mps, 5.0);
  EXPECT_NEAR(gaps.behind.metres, 200.0 - kCarLength_m, 1e-9);
}

TEST(Gap, NobodyKnownIsNoGap) {
  const std::array unknown{Runner{}};
  EXPECT_TRUE(std::isnan(gaps_of({1'000.0, 60.0}, unknown, kLap_m).ahead.metres));
  EXPECT_TRUE(std::isnan(to(1'050.0, kUnset).ahead.metres));
  const std::array known{Runner{1'050.0, 50.0}};
  EXPECT_TRUE(std::isnan(gaps_of({1'000.0, 60.0}, known, kUnset).ahead.metres));
}

}  // namespace
}  // namespace pitwall::state
