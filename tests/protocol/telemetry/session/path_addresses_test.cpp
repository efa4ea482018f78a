// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/path_addresses.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace pitwall::telemetry {
namespace {

constexpr Address kOld{.ip = 1, .port = 1}, kNew{.ip = 2, .port = 2}, kThird{.ip = 3, .port = 3};

struct Road {
  PathAddresses addresses;
  SeededRandomness randomness{1};

  void heard(Address from, bool newest = true) { addresses.heard(from, 100, newest, randomness); }
  bool serves(Address address, std::size_t size = 1) const {
    const auto targets = addresses.targets(size);
    return std::find(targets.begin(), targets.end(), address) != targets.end();
  }
};

TEST(PathAddresses, NobodyIsServedBeforeAnybodyWasHeard) {
  EXPECT_TRUE(Road{}.addresses.targets(1).empty());
}

TEST(PathAddresses, AnAddressOnTrialGetsThreeTimesWhatItSent) {
  Road road;
  road.heard(kNew);
  EXPECT_TRUE(road.serves(kNew, 300));
  EXPECT_FALSE(road.serves(kNew, 301));
  road.addresses.note_sent(kNew, 300);
  EXPECT_FALSE(road.serves(kNew, 1));
  road.heard(kNew, false);
  EXPECT_TRUE(road.serves(kNew, 300));
}

TEST(PathAddresses, TheOldOneIsServedUntilTheNewOneProvedItself) {
  Road road;
  road.addresses.prove(kOld);
  road.heard(kNew);
  EXPECT_TRUE(road.serves(kOld) && road.serves(kNew));
  const auto token = road.addresses.token();
  ASSERT_TRUE(token);
  EXPECT_FALSE(road.addresses.take_proof(kOld, *token));
  EXPECT_FALSE(road.addresses.take_proof(kThird, *token));
  EXPECT_FALSE(road.addresses.take_proof(kNew, *token ^ 1));
  EXPECT_TRUE(road.addresses.take_proof(kNew, *token));
  EXPECT_TRUE(!road.serves(kOld) && road.serves(kNew, 1'000'000));
  EXPECT_FALSE(road.addresses.take_proof(kNew, *token)) << "once";
}

TEST(PathAddresses, WhatIsNotTheNewestBeginsNoTrial) {
  Road road;
  road.addresses.prove(kOld);
  road.heard(kNew, false);
  EXPECT_FALSE(road.addresses.token());
}

TEST(PathAddresses, APeerThatIsWhereItWasEndsTheTrial) {
  Road road;
  road.addresses.prove(kOld);
  road.heard(kNew);
  road.heard(kOld, false);
  EXPECT_TRUE(road.addresses.token()) << "that packet was only late";
  road.heard(kOld);
  EXPECT_FALSE(road.addresses.token());
}

TEST(PathAddresses, EachTrialHasItsOwnToken) {
  Road road;
  road.addresses.prove(kOld);
  road.heard(kNew);
  const auto first = road.addresses.token();
  road.heard(kThird);
  EXPECT_NE(road.addresses.token(), first);
  EXPECT_FALSE(road.addresses.take_proof(kThird, *first));
}

}  // namespace
}  // namespace pitwall::telemetry
