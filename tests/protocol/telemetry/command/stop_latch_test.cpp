// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/command/stop_latch.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/protocol/telemetry/command/two_ends.hpp"

namespace pitwall::telemetry {
namespace {

using testing::TwoEnds;

constexpr Instant kNow{};
constexpr StopState kPressed{StopLevel::kEmergency, 1, StopReason::kOperator};

// Gate: a hundred thousand presses, each at its own moment of a bad link: the first packet of the
// base that gets through after it closes the latch, whatever was lost before.
TEST(StopLatch, ClosesOnTheFirstPacketThatSurvivesInHundredThousandTrials) {
  std::mt19937 random(5);
  const auto lost = [&] { return static_cast<int>(random() % 7); };
  for (int trial = 0; trial < 100'000; ++trial) {
    StopTransmitter transmitter;
    StopLatch latch;
    for (int before = lost(); before > 0; --before) latch.receive(transmitter.state(), kNow);
    const auto level = random() % 2 == 0 ? StopLevel::kControlled : StopLevel::kEmergency;
    transmitter.demand(level, StopReason::kOperator);
    const int gone = lost();  // never heard
    ASSERT_EQ(latch.level(), StopLevel::kNone);
    Values packet;
    put(transmitter.state(), packet);
    latch.receive(*stop_state_of(packet), kNow + milliseconds(20 * gone));
    ASSERT_EQ(latch.level(), level);
    ASSERT_EQ(latch.reason(), StopReason::kOperator);
    ASSERT_NE(latch.challenge(), 0);
  }
}

// Anything that a network or a restart of the base can do, in any order, but for the release.
TEST(StopLatch, NothingButItsChallengeOpensIt) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 20'000; ++trial) {
    StopLatch latch;
    latch.draw(static_cast<std::uint16_t>(random()));
    latch.receive(kPressed, kNow);
    for (int i = 0; i < 20; ++i) {
      const StopState any{static_cast<StopLevel>(random() % 3),
                          static_cast<std::uint8_t>(random() % kStopEpochs), StopReason::kTest};
      const std::uint16_t challenge = latch.challenge();
      switch (random() % 4) {
        case 0:
          latch.receive(any, kNow + milliseconds(i));
          break;
        case 1:
          latch.base_restarted();
          break;
        case 2:
          EXPECT_FALSE(latch.release(challenge, false)) << "the car moves";
          break;
        default:
          EXPECT_FALSE(
              latch.release(static_cast<std::uint16_t>(challenge + 1 + random() % 9), true));
      }
      ASSERT_EQ(latch.level(), StopLevel::kEmergency);
    }
    EXPECT_TRUE(latch.release(latch.challenge(), true));
    EXPECT_EQ(latch.level(), StopLevel::kNone);
    EXPECT_EQ(latch.challenge(), 0);
  }
}

TEST(StopLatch, StaysOpenWhileTheBaseHasNotHeardOfTheRelease) {
  StopTransmitter transmitter;
  StopLatch latch;
  transmitter.demand(StopLevel::kControlled, StopReason::kOperator);
  latch.receive(transmitter.state(), kNow);
  transmitter.release_asked(1);
  ASSERT_TRUE(latch.release(latch.challenge(), true));
  for (int i = 0; i < 100; ++i) latch.receive(transmitter.state(), kNow);
  EXPECT_EQ(latch.level(), StopLevel::kNone);
  transmitter.released(1);
  EXPECT_EQ(transmitter.state().level, StopLevel::kNone);
  transmitter.demand(StopLevel::kControlled, StopReason::kOperator);
  latch.receive(transmitter.state(), kNow);
  EXPECT_EQ(latch.level(), StopLevel::kControlled) << "the next press counts";
}

// The operator presses again while the release is on its way, before it arrives or after.
TEST(StopLatch, APressWinsOverAReleaseThatIsOnItsWay) {
  for (const bool press_arrives_first : {true, false}) {
    StopTransmitter transmitter;
    StopLatch latch;
    transmitter.demand(StopLevel::kEmergency, StopReason::kOperator);
    latch.receive(transmitter.state(), kNow);
    const std::uint16_t challenge = latch.challenge();
    transmitter.release_asked(1);
    transmitter.demand(StopLevel::kEmergency, StopReason::kOperator);
    if (press_arrives_first) latch.receive(transmitter.state(), kNow);
    EXPECT_EQ(latch.release(challenge, true), !press_arrives_first);
    latch.receive(transmitter.state(), kNow);
    transmitter.released(1);
    latch.receive(transmitter.state(), kNow);
    EXPECT_EQ(latch.level(), StopLevel::kEmergency);
    EXPECT_EQ(transmitter.state().level, StopLevel::kEmergency);
  }
}

TEST(StopLatch, AnOldPacketAfterTheReleaseClosesNothing) {
  StopTransmitter transmitter;
  StopLatch latch;
  transmitter.demand(StopLevel::kControlled, StopReason::kOperator);
  const StopState old = transmitter.state();
  transmitter.demand(StopLevel::kEmergency, StopReason::kOperator);
  latch.receive(transmitter.state(), kNow);
  ASSERT_TRUE(latch.release(latch.challenge(), true));
  latch.receive(old, kNow);
  EXPECT_EQ(latch.level(), StopLevel::kNone);
}

TEST(StopLatch, ARestartOfTheBaseRaisesNothingReleasesNothingAndIsHeardAgain) {
  StopLatch latch;
  latch.receive(kPressed, kNow);
  latch.base_restarted();
  StopTransmitter reborn;
  latch.receive(reborn.state(), kNow);
  EXPECT_EQ(latch.level(), StopLevel::kEmergency);
  ASSERT_TRUE(latch.release(latch.challenge(), true));
  latch.base_restarted();
  latch.receive(StopTransmitter{}.state(), kNow);
  EXPECT_EQ(latch.level(), StopLevel::kNone);
  // Its first press has the epoch of the one that was released.
  reborn.demand(StopLevel::kEmergency, StopReason::kOperator);
  ASSERT_EQ(reborn.state().epoch, kPressed.epoch);
  latch.receive(reborn.state(), kNow);
  EXPECT_EQ(latch.level(), StopLevel::kEmergency);
}

TEST(StopLatch, ChallengesDifferFromLatchToLatchAndHaveNoUnsetValue) {
  StopLatch latch;
  StopTransmitter transmitter;
  std::uint16_t last = 0;
  for (unsigned i = 0; i < 70'000; ++i) {
    if (i % 3 == 0) latch.draw(static_cast<std::uint16_t>(i));
    transmitter.demand(StopLevel::kControlled, StopReason::kOperator);
    latch.receive(transmitter.state(), kNow);
    ASSERT_NE(latch.challenge(), last);
    ASSERT_GE(latch.challenge(), 1);
    ASSERT_LE(latch.challenge(), 65'534);
    last = latch.challenge();
    ASSERT_TRUE(latch.release(last, true));
    transmitter.release_asked(i + 1);
    transmitter.released(i + 1);
  }
}

TEST(StopLatch, AHigherLevelRaisesALowerOneDoesNotLower) {
  StopLatch latch;
  latch.receive({StopLevel::kControlled, 1, StopReason::kOperator}, kNow);
  latch.receive({StopLevel::kEmergency, 2, StopReason::kPitCrew}, kNow + seconds(1));
  EXPECT_EQ(latch.level(), StopLevel::kEmergency);
  EXPECT_EQ(latch.reason(), StopReason::kPitCrew);
  EXPECT_EQ(latch.since(), kNow);
  latch.receive({StopLevel::kControlled, 3, StopReason::kOperator}, kNow + seconds(2));
  EXPECT_EQ(latch.level(), StopLevel::kEmergency);
  EXPECT_EQ(latch.reason(), StopReason::kPitCrew);
}

TEST(StopLatch, AButtonThatIsHeldDownIsOnePress) {
  StopTransmitter transmitter;
  transmitter.demand(StopLevel::kControlled, StopReason::kOperator);
  const StopState once = transmitter.state();
  for (int i = 0; i < 1'000; ++i) transmitter.demand(StopLevel::kControlled, StopReason::kOperator);
  EXPECT_EQ(transmitter.state(), once);
  transmitter.demand(StopLevel::kNone, StopReason::kNone);
  EXPECT_EQ(transmitter.state(), once) << "nothing lowers it";
}

TEST(StopLatch, UnsetFieldsAreNoState) {
  Values values;
  EXPECT_FALSE(stop_state_of(values));
  put(kPressed, values);
  ASSERT_TRUE(stop_state_of(values));
  EXPECT_EQ(*stop_state_of(values), kPressed);
  values[field("stop.reason")] = 12;  // of a later build
  ASSERT_TRUE(stop_state_of(values));
  EXPECT_EQ(stop_state_of(values)->level, StopLevel::kEmergency);
  values[field("stop.epoch")] = kUnset;
  EXPECT_FALSE(stop_state_of(values));
}

// Over the air of half of all packets lost: latched until the release, then open at both ends.
TEST(StopLatch, TwoStepsOverABadLinkReleaseIt) {
  TwoEnds rig({.fading = {.loss = 0.5}, .seed = 31});
  rig.releases = true;
  for (int round = 0; round < 50; ++round) {
    rig.stop.demand(StopLevel::kControlled, StopReason::kOperator);
    rig.run(seconds(1));
    ASSERT_EQ(rig.latch.level(), StopLevel::kControlled);
    const auto id = rig.issue(CommandType::kReleaseStop, rig.latch.challenge());
    ASSERT_TRUE(id);
    rig.stop.release_asked(*id);
    rig.stands = true;
    rig.run(seconds(2));
    rig.stands = false;
    ASSERT_EQ(rig.transmitter.progress(*id)->outcome, Outcome::kApplied);
    rig.stop.released(*id);
    rig.run(seconds(1));
    ASSERT_EQ(rig.latch.level(), StopLevel::kNone);
  }
}

}  // namespace
}  // namespace pitwall::telemetry
