// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/slip.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::state {
namespace {

WheelSpeeds wheels(double front, double rear, double split = 0.0) {
  return {front - split, front + split, rear - split, rear + split};
}

TEST(Slip, RearAgainstFrontAndGnss) {
  const Slip slip = slip_of(wheels(60.0, 66.0), 55.0);
  EXPECT_NEAR(slip.rear_front, 0.10, 1e-12);
  EXPECT_NEAR(slip.rear_gnss, 0.20, 1e-12);
  EXPECT_NEAR(slip.worst(), 0.20, 1e-12);
}

// A corner turns the outer wheels faster than the inner ones, on both axles alike.
TEST(Slip, ACornerIsNoSlip) {
  for (double speed = 21.0; speed < 80.0; speed += 3.0) {
    EXPECT_NEAR(slip_of(wheels(speed, speed, speed * 0.05), speed).worst(), 0.0, 1e-12);
  }
}

TEST(Slip, BelowTheSpeedOfTheRuleThereIsNone) {
  EXPECT_EQ(slip_of(wheels(10.0, 15.0), 10.0).worst(), 0.0);
  EXPECT_EQ(slip_of(wheels(0.0, 0.0), 0.0).worst(), 0.0);
}

TEST(Slip, WhatIsMissingIsNotJudged) {
  EXPECT_TRUE(std::isnan(slip_of(wheels(60.0, 66.0), kUnset).rear_gnss));
  EXPECT_NEAR(slip_of(wheels(60.0, 66.0), kUnset).worst(), 0.10, 1e-12);
  EXPECT_TRUE(std::isnan(slip_of(wheels(kUnset, 66.0), kUnset).worst()));
  WheelSpeeds one_gone = wheels(60.0, 66.0);
  one_gone.rear_left_mps = kUnset;
  EXPECT_TRUE(std::isnan(slip_of(one_gone, 60.0).worst()));
}

}  // namespace
}  // namespace pitwall::state
