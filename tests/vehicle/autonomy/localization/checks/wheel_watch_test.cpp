// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/checks/wheel_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::localization {
namespace {

constexpr double kHalfTrack_m = 0.82;

// A car with four wheels, one of which may lie, at 100 Hz.
struct WheelRig {
  CheckParams params{};
  WheelWatch watch{};
  double speed_mps = 50.0, yaw_rate_rad_per_s = 0.0, by_receivers_mps = kUnset;
  std::array<double, world::kCorners> factor{1.0, 1.0, 1.0, 1.0};
  bool watched = true;
  Instant now{seconds(3).ns};

  WheelSpeed tick() {
    now += milliseconds(10);
    WheelFacts facts;
    facts.yaw_rate_rad_per_s = yaw_rate_rad_per_s;
    facts.by_receivers_mps = by_receivers_mps;
    const double side = kHalfTrack_m * yaw_rate_rad_per_s;
    facts.speed_mps.at = {speed_mps - side, speed_mps + side, speed_mps - side, speed_mps + side};
    for (std::size_t i = 0; i < world::kCorners; ++i) facts.speed_mps.at[i] *= factor[i];
    return watch_wheels(params, watch, facts, watched, now);
  }
};

TEST(WheelWatch, FourGoodWheelsSayTheSpeedOnStraightsAndInTurns) {
  for (const double speed : {0.0, 3.0, 30.0, 80.0}) {
    for (const double turn : {-0.4, 0.0, 0.4}) {
      WheelRig rig{.speed_mps = speed, .yaw_rate_rad_per_s = turn};
      const WheelSpeed stated = rig.tick();
      EXPECT_NEAR(stated.speed_mps, speed, 1e-9) << speed << " " << turn;
      EXPECT_FALSE(stated.contradiction);
    }
  }
}

// The law for each wheel: whatever one of them does, the speed is that of the others.
TEST(WheelWatch, AnyOneWheelThatLocksSpinsOrIsLostDoesNotEnter) {
  for (const bool with_receivers : {false, true}) {
    for (std::size_t wheel = 0; wheel < world::kCorners; ++wheel) {
      for (const double factor : {0.0, 0.5, 1.3, 3.0, -1.0, kUnset, 1e9}) {
        WheelRig rig;
        if (with_receivers) rig.by_receivers_mps = rig.speed_mps;
        rig.tick();
        rig.factor[wheel] = factor;
        for (int i = 0; i < 50; ++i) {
          const WheelSpeed stated = rig.tick();
          ASSERT_NEAR(stated.speed_mps, rig.speed_mps, 1e-9) << wheel << " " << factor;
          ASSERT_TRUE(stated.contradiction);
        }
      }
    }
  }
}

TEST(WheelWatch, AWheelComesBackAfterAWhileOfAgreement) {
  WheelRig rig;
  rig.factor[2] = 0.0;
  rig.tick();
  rig.factor[2] = 1.0;
  int out_for = 0;
  while (rig.tick().contradiction && out_for < 1000) ++out_for;
  EXPECT_NEAR(out_for * 0.01, rig.params.readmit_after_s, 0.02);
}

TEST(WheelWatch, FourWheelsThatLockAreContradictedByTheReceivers) {
  WheelRig rig{.by_receivers_mps = 50.0};
  rig.factor.fill(0.2);
  const WheelSpeed stated = rig.tick();
  EXPECT_TRUE(std::isnan(stated.speed_mps));
  EXPECT_TRUE(stated.contradiction);
}

TEST(WheelWatch, ASidesLossLeavesTheOther) {
  WheelRig rig{.by_receivers_mps = 50.0};
  rig.factor[0] = rig.factor[2] = 0.0;
  EXPECT_NEAR(rig.tick().speed_mps, 50.0, 1e-9);
}

// Slip and scatter of a healthy car: tyre growth of 1.4 %, driven wheels 3 % faster.
TEST(WheelWatch, OrdinarySlipIsNoContradiction) {
  for (const double speed : {2.0, 20.0, 68.0, 80.0}) {
    WheelRig rig{.speed_mps = speed, .by_receivers_mps = speed};
    rig.factor = {0.986, 0.986, 1.015, 1.02};
    for (int i = 0; i < 100; ++i) EXPECT_FALSE(rig.tick().contradiction) << speed;
  }
}

TEST(WheelWatch, UnwatchedALockedWheelEnters) {
  WheelRig rig;
  rig.watched = false;
  rig.factor[3] = 0.0;
  const WheelSpeed stated = rig.tick();
  EXPECT_NEAR(stated.speed_mps, 37.5, 1e-9);
  EXPECT_FALSE(stated.contradiction);
}

}  // namespace
}  // namespace pitwall::localization
