// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/laps/lap_progress.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::state {
namespace {

using enum LapMove::Kind;

constexpr double kAround_m = 1'000.0;
constexpr Instant kBegin{seconds(50).ns};

class Progress : public ::testing::Test {
 protected:
  LapMove take(double at_s, double station_m) {
    return progress_.take(kBegin + from_seconds(at_s), station_m);
  }
  LapProgress progress_{kAround_m};
};

TEST_F(Progress, CountsTheWayFromTheLineOn) {
  EXPECT_EQ(take(0.0, 990.0).kind, kBegins);
  const LapMove move = take(0.1, 5.0);
  EXPECT_EQ(move.kind, kSeen);
  EXPECT_DOUBLE_EQ(move.from_m, 990.0);
  EXPECT_DOUBLE_EQ(move.to_m, 1'005.0);
  progress_.cross_line();
  const LapMove next = take(0.2, 12.0);
  EXPECT_DOUBLE_EQ(next.from_m, 5.0);
  EXPECT_DOUBLE_EQ(next.to_m, 12.0);
  EXPECT_EQ(next.from, kBegin + from_seconds(0.1));
}

TEST_F(Progress, BackOverTheLineIsAWayBelowZero) {
  take(0.0, 1.0);
  const LapMove move = take(0.1, 998.0);
  EXPECT_EQ(move.kind, kSeen);
  EXPECT_DOUBLE_EQ(move.to_m, -2.0);
  EXPECT_DOUBLE_EQ(take(0.2, 3.0).to_m, 3.0);
}

TEST_F(Progress, HalfALapBackFromTheLineTheWayIsLost) {
  take(0.0, 100.0);
  for (int i = 1; i <= 30; ++i) {
    const LapMove move = take(0.2 * i, std::fmod(1'100.0 - 20.0 * i, kAround_m));
    ASSERT_EQ(move.kind, kSeen) << i;
    ASSERT_DOUBLE_EQ(move.to_m, 100.0 - 20.0 * i);
  }
  EXPECT_EQ(take(6.2, 480.0).kind, kBegins);
}

TEST_F(Progress, ASilenceIsUnseenUpToThePlaceWhereTheCarMustBe) {
  take(0.0, 100.0);
  EXPECT_EQ(take(0.5, 110.0).kind, kSeen) << "not longer than a gap";
  const LapMove far = take(6.5, 800.0);  // 690 m in 6 s: 720 m at most, and 5 m
  EXPECT_EQ(far.kind, kUnseen);
  EXPECT_DOUBLE_EQ(far.to_m, 800.0);
  EXPECT_EQ(take(12.5, 600.0).kind, kBegins) << "800 m in 6 s";
  EXPECT_EQ(take(21.0, 650.0).kind, kBegins) << "1020 m may lie between";
}

TEST_F(Progress, ASilenceMayLieOverTheLine) {
  take(0.0, 900.0);
  const LapMove move = take(3.0, 60.0);
  EXPECT_EQ(move.kind, kUnseen);
  EXPECT_DOUBLE_EQ(move.to_m, 1'060.0);
}

TEST_F(Progress, AJumpIsNotDriven) {
  take(0.0, 100.0);
  EXPECT_EQ(take(0.1, 116.0).kind, kSeen);
  EXPECT_EQ(take(0.2, 134.0).kind, kBegins) << "180 m/s";
  EXPECT_EQ(take(0.3, 110.0).kind, kBegins) << "as far back";
}

TEST_F(Progress, WhatIsUnknownOrNotNewerIsNothing) {
  EXPECT_EQ(take(0.0, kUnset).kind, kNone);
  take(0.0, 100.0);
  EXPECT_EQ(take(0.0, 101.0).kind, kNone);
  EXPECT_EQ(take(-1.0, 101.0).kind, kNone);
  EXPECT_EQ(take(0.1, kUnset).kind, kNone);
  EXPECT_DOUBLE_EQ(take(0.2, 104.0).from_m, 100.0);
}

}  // namespace
}  // namespace pitwall::state
