// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/path_addresses.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace pitwall::telemetry {
namespace {

constexpr UdpAddress kOld{.ip = 1, .port = 1}, kNew{.ip = 2, .port = 2}, kThird{.ip = 3, .port = 3};

struct Road {
  PathAddresses addresses;
  SeededRandomness randomness{1};

  Instant now{seconds(1).ns};
  std::uint64_t number = 0;

  void receive(UdpAddress from, bool newest = true) {
    if (newest) ++number;
    addresses.receive({.from = from, .size = 100, .number = number, .newest = newest}, now,
                      randomness);
  }
  bool proves(UdpAddress from, std::uint64_t token) {
    return addresses.take_proof(from, token, now);
  }
  bool serves(UdpAddress address, std::size_t size = 1) const {
    const auto targets = addresses.targets(size);
    return std::find(targets.begin(), targets.end(), address) != targets.end();
  }
};

TEST(PathAddresses, NobodyIsServedBeforeAnybodyWasHeard) {
  EXPECT_TRUE(Road{}.addresses.targets(1).empty());
}

TEST(PathAddresses, AnAddressOnTrialGetsThreeTimesWhatItSent) {
  Road road;
  road.receive(kNew);
  EXPECT_TRUE(road.serves(kNew, 300));
  EXPECT_FALSE(road.serves(kNew, 301));
  road.addresses.note_sent(kNew, 300);
  EXPECT_FALSE(road.serves(kNew, 1));
  road.receive(kNew, false);
  EXPECT_TRUE(road.serves(kNew, 300));
}

TEST(PathAddresses, TheOldOneIsServedUntilTheNewOneProvedItself) {
  Road road;
  road.addresses.prove(kOld);
  road.receive(kNew);
  EXPECT_TRUE(road.serves(kOld) && road.serves(kNew));
  const auto token = road.addresses.token();
  ASSERT_TRUE(token);
  EXPECT_FALSE(road.proves(kOld, *token));
  EXPECT_FALSE(road.proves(kThird, *token));
  EXPECT_FALSE(road.proves(kNew, *token ^ 1));
  EXPECT_TRUE(road.proves(kNew, *token));
  EXPECT_TRUE(!road.serves(kOld) && road.serves(kNew, 1'000'000));
  EXPECT_FALSE(road.proves(kNew, *token)) << "once";
}

TEST(PathAddresses, WhatIsNotTheNewestBeginsNoTrial) {
  Road road;
  road.addresses.prove(kOld);
  road.receive(kNew, false);
  EXPECT_FALSE(road.addresses.token());
}

TEST(PathAddresses, APeerThatIsWhereItWasEndsTheTrial) {
  Road road;
  road.addresses.prove(kOld);
  road.receive(kNew);
  --road.number;
  road.receive(kOld, false);
  EXPECT_TRUE(road.addresses.token()) << "that packet was only late";
  ++road.number;
  road.receive(kOld);
  EXPECT_FALSE(road.addresses.token());
}

// Who forwards each packet a little faster than its own way sends nothing of his own.
TEST(PathAddresses, ARelayIsNotProvedWhileThePeerItselfIsHeard) {
  Road road;
  road.addresses.prove(kOld);
  for (int i = 0; i < 50; ++i) {
    road.receive(kNew);
    road.now += milliseconds(1);
    road.receive(kOld, false);  // the same packet by its own way
    const auto token = road.addresses.token();
    ASSERT_TRUE(token);
    ASSERT_FALSE(road.proves(kNew, *token));
    ASSERT_TRUE(road.serves(kOld) && road.serves(kNew)) << "both, until one is silent";
    road.now += milliseconds(19);
  }
  const auto token = road.addresses.token();
  road.receive(kNew);
  road.now += PathAddresses::kInUse - milliseconds(19);
  EXPECT_TRUE(road.proves(kNew, *token))
      << "a peer that did move is believed when the old is silent";
}

TEST(PathAddresses, APacketOfBeforeTheMoveThatComesLateOpposesNothing) {
  Road road;
  road.addresses.prove(kOld);
  road.number = 7;
  road.receive(kNew);
  road.number = 6;
  road.receive(kOld, false);
  EXPECT_TRUE(road.proves(kNew, *road.addresses.token()));
}

TEST(PathAddresses, EachTrialHasItsOwnToken) {
  Road road;
  road.addresses.prove(kOld);
  road.receive(kNew);
  const auto first = road.addresses.token();
  road.receive(kThird);
  EXPECT_NE(road.addresses.token(), first);
  EXPECT_FALSE(road.proves(kThird, *first));
}

}  // namespace
}  // namespace pitwall::telemetry
