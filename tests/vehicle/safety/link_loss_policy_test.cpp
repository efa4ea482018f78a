// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/link_loss_policy.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::safety {
namespace {

constexpr LinkLossParams kParams{};
const Instant kNow{seconds(100).ns};

StreamRow link(Duration age) {
  const Health health = age > seconds(3)   ? Health::kBad
                        : age > seconds(1) ? Health::kWarning
                                           : Health::kGood;
  return {Stream::kRadio, health, age};
}

TEST(LinkLossPolicy, EachRungBeginsAfterItsLimitAndNotBefore) {
  const auto level = [](Duration age) {
    LinkLossState state;
    return apply_link_loss_policy(kParams, state, link(age), {}, kNow).level;
  };
  const Duration step = nanoseconds(1);
  EXPECT_EQ(level({}), LinkLossLevel::kFull);
  EXPECT_EQ(level(kParams.joystick_dropped), LinkLossLevel::kFull);
  EXPECT_EQ(level(kParams.joystick_dropped + step), LinkLossLevel::kJoystickDropped);
  EXPECT_EQ(level(kParams.override_gone), LinkLossLevel::kJoystickDropped);
  EXPECT_EQ(level(kParams.override_gone + step), LinkLossLevel::kOverrideGone);
  EXPECT_EQ(level(kParams.no_comm), LinkLossLevel::kOverrideGone);
  EXPECT_EQ(level(kParams.no_comm + step), LinkLossLevel::kNoComm);
  EXPECT_EQ(level(seconds(3)), LinkLossLevel::kNoComm);
  EXPECT_EQ(level(seconds(3) + step), LinkLossLevel::kStop);
}

TEST(LinkLossPolicy, WithoutARadioItDrivesOnOnlyWhereTheMissionAllowsIt) {
  LinkLossParams stays = kParams;
  stays.no_comm_drives = false;
  for (const Duration age : {milliseconds(500), milliseconds(1'001), milliseconds(3'001)}) {
    LinkLossState state;
    const auto drives = apply_link_loss_policy(kParams, state, link(age), {}, kNow);
    EXPECT_EQ(drives.stop, age > seconds(3));
    EXPECT_EQ(std::isnan(drives.speed_limit_mps), age < seconds(1));
    if (age > seconds(1)) {
      EXPECT_EQ(drives.speed_limit_mps, kParams.no_comm_speed_mps);
    }
    const auto stops = apply_link_loss_policy(stays, state, link(age), {}, kNow);
    EXPECT_EQ(stops.stop, age > seconds(1));
    EXPECT_TRUE(std::isnan(stops.speed_limit_mps));
  }
}

TEST(LinkLossPolicy, ABaseThatWasNeverHeardLimitsNothingAndALinkThatNobodyWatchesIsWhole) {
  LinkLossState state;
  const auto never =
      apply_link_loss_policy(kParams, state, {Stream::kRadio, Health::kNever, {}}, {}, kNow);
  EXPECT_EQ(never.level, LinkLossLevel::kStop);
  EXPECT_TRUE(std::isnan(never.speed_limit_mps));
  const auto unwatched = apply_link_loss_policy(
      kParams, state, {Stream::kRadio, Health::kUnwatched, seconds(9)}, {}, kNow);
  EXPECT_EQ(unwatched.level, LinkLossLevel::kFull);
  EXPECT_FALSE(unwatched.stop);
}

// From the newest sample on: all of it, then evenly less, then nothing; never a step, never faster
// than the joystick said before it should be.
TEST(LinkLossPolicy, AJoystickThatFallsSilentIsHandedBackEvenly) {
  LinkLossState state;
  const world::Joystick joystick{.throttle_cap = 0.2, .brake = 0.8, .at = kNow};
  double cap = 0.0, brake = 1.0;
  for (int ms = 0; ms <= 700; ++ms) {
    const Instant now = kNow + milliseconds(ms);
    const auto sample = ms == 0 ? std::optional{joystick} : std::nullopt;
    const auto out = apply_link_loss_policy(kParams, state, link(milliseconds(ms)), sample, now);
    if (ms <= 200) {
      EXPECT_DOUBLE_EQ(out.throttle_cap, 0.2);
      EXPECT_DOUBLE_EQ(out.brake, 0.8);
    } else {
      EXPECT_GE(out.throttle_cap, cap);
      EXPECT_LE(out.throttle_cap - cap, 0.8 / 300.0 + 1e-9);
      EXPECT_LE(brake - out.brake, 0.8 / 300.0 + 1e-9);
    }
    if (ms >= 500) {
      EXPECT_EQ(out.throttle_cap, 1.0);
      EXPECT_EQ(out.brake, 0.0);
    }
    cap = out.throttle_cap;
    brake = out.brake;
  }
  EXPECT_FALSE(state.joystick) << "nothing is kept of it";
}

// The device is gone, the link is alive: the sample's age decides, not the link's.
TEST(LinkLossPolicy, ALiveLinkKeepsNoOldSample) {
  LinkLossState state;
  const world::Joystick joystick{.throttle_cap = 0.0, .brake = 1.0, .at = kNow};
  for (const auto& sample : {std::optional{joystick}, std::optional<world::Joystick>{}}) {
    const auto out =
        apply_link_loss_policy(kParams, state, link({}), sample, kNow + milliseconds(600));
    EXPECT_EQ(out.level, LinkLossLevel::kFull);
    EXPECT_EQ(out.throttle_cap, 1.0);
    EXPECT_EQ(out.brake, 0.0);
  }
}

TEST(LinkLossPolicy, ASampleFromTheFutureOrOutOfRangeMakesNothingFaster) {
  LinkLossState state;
  const world::Joystick future{.throttle_cap = 0.0, .brake = 1.0, .at = kNow + seconds(1)};
  EXPECT_EQ(apply_link_loss_policy(kParams, state, link({}), future, kNow).brake, 0.0);
  const world::Joystick wild{.throttle_cap = 7.0, .brake = -3.0, .at = kNow};
  const auto out = apply_link_loss_policy(kParams, state, link({}), wild, kNow);
  EXPECT_EQ(out.throttle_cap, 1.0);
  EXPECT_EQ(out.brake, 0.0);
}

}  // namespace
}  // namespace pitwall::safety
