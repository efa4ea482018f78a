// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/command/authority.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/protocol/telemetry/command/two_ends.hpp"

namespace pitwall::telemetry {
namespace {

using testing::kOperator;
using testing::TwoEnds;

constexpr HolderId kA = 1, kB = 2;

struct Statement {
  Values values;
  Received received;
};
Statement say(const AuthorityRegister& authority, Instant now, Duration way = milliseconds(20)) {
  Statement stated;
  authority.put(stated.values, now);
  stated.received.at = now + way;
  stated.received.sent_earliest = now;
  return stated;
}
void receive(AuthorityView& view, const Statement& stated) {
  view.receive(stated.values, stated.received);
}

TEST(AuthorityRegister, OneHolderUntilItDropsHandsOverOrExpires) {
  AuthorityRegister authority;
  const Instant t{seconds(10).ns};
  EXPECT_EQ(authority.holder(t), 0);
  EXPECT_TRUE(authority.take(kA, t));
  EXPECT_FALSE(authority.take(kB, t));
  EXPECT_FALSE(authority.renew(kB, t));
  EXPECT_FALSE(authority.hand_over(kB, kB, t));
  EXPECT_TRUE(authority.hand_over(kA, kB, t));
  EXPECT_EQ(authority.holder(t), kB);
  EXPECT_FALSE(authority.renew(kA, t));
  authority.drop(kA, t);
  EXPECT_EQ(authority.holder(t), kB);
  authority.drop(kB, t);
  EXPECT_EQ(authority.holder(t), 0);
  EXPECT_TRUE(authority.take(kA, t));
  EXPECT_EQ(authority.holder(t + kAuthorityExpiry - nanoseconds(1)), kA);
  EXPECT_EQ(authority.holder(t + kAuthorityExpiry), 0);
  EXPECT_FALSE(authority.renew(kA, t + kAuthorityExpiry)) << "what is gone must be taken again";
  EXPECT_FALSE(authority.take(0, t + kAuthorityExpiry));
}

TEST(AuthorityView, ExpiresByTheMomentOfTheRenewalHoweverLongThePacketsWereOnTheirWay) {
  for (const int way_ms : {0, 20, 400, 2'000, 2'980, 3'000, 5'000}) {
    AuthorityRegister authority;
    AuthorityView view;
    const Instant t{seconds(10).ns};
    authority.take(kA, t);
    for (int ms = 0; ms < 3'000; ms += 20)
      receive(view, say(authority, t + milliseconds(ms), milliseconds(way_ms)));
    EXPECT_EQ(view.holder(t + kAuthorityExpiry), 0) << way_ms;
    if (way_ms < 2'980) {
      EXPECT_EQ(view.holder(t + milliseconds(2'980)), kA) << way_ms;
    }
  }
}

// The console is frozen; its base and the link are alive and repeat what it said last.
TEST(AuthorityView, RepeatedPacketsRenewNothing) {
  TwoEnds rig({.seed = 41});
  rig.run(seconds(5));
  ASSERT_EQ(rig.view.holder(rig.car_now()), kOperator);
  rig.renews = false;
  rig.run(kAuthorityExpiry + milliseconds(20));
  EXPECT_EQ(rig.view.holder(rig.car_now()), 0);
  const auto id = rig.issue(CommandType::kArm, 1.0);
  rig.run(seconds(1));
  EXPECT_EQ(rig.transmitter.progress(*id)->outcome, Outcome::kNoAuthority);
  const auto free = rig.issue(CommandType::kSendParameters, 1.0);
  rig.run(seconds(1));
  EXPECT_EQ(rig.transmitter.progress(*free)->outcome, Outcome::kApplied) << "it needs no authority";
}

TEST(AuthorityView, HoldsOverABadLinkAndEndsWithinItsTimeWhenTheLinkEnds) {
  for (std::uint32_t seed = 50; seed < 60; ++seed) {
    TwoEnds rig({.fading = {.loss = 0.5, .mean_fade = milliseconds(120), .loss_between = 0.02},
                 .clock_bound = milliseconds(20),
                 .seed = seed});
    rig.run(seconds(2));
    int barred_ms = 0;
    for (int ms = 0; ms < 60'000; ++ms) {
      rig.run(milliseconds(1));
      barred_ms += rig.view.held(rig.car_now()) ? 0 : 1;
    }
    EXPECT_EQ(barred_ms, 0) << seed;
    rig.up.cut = true;
    rig.run(kAuthorityExpiry + milliseconds(20));
    EXPECT_FALSE(rig.view.held(rig.car_now())) << seed;
  }
}

TEST(AuthorityView, APacketOfAnOlderEpochChangesNothing) {
  AuthorityRegister authority;
  AuthorityView view;
  const Instant t{seconds(10).ns};
  authority.take(kA, t);
  const Statement of_a = say(authority, t);
  authority.hand_over(kA, kB, t);
  receive(view, say(authority, t + milliseconds(20)));
  receive(view, of_a);
  EXPECT_EQ(view.holder(t + milliseconds(40)), kB);
  authority.drop(kB, t + milliseconds(40));
  const Statement of_nobody = say(authority, t + milliseconds(40));
  receive(view, of_nobody);
  receive(view, of_a);
  EXPECT_EQ(view.holder(t + milliseconds(60)), 0);
}

TEST(AuthorityView, OneFutureEpochLocksNobodyOutForLongerThanItsExpiry) {
  AuthorityRegister far, authority;
  AuthorityView view;
  Instant t{seconds(10).ns};
  for (int i = 0; i < 30'000; ++i) {
    far.take(kB, t);
    far.drop(kB, t);
  }
  far.take(kB, t);
  receive(view, say(far, t));
  authority.take(kA, t);
  for (int ms = 0; ms < 3'100; ms += 20, t += milliseconds(20)) {
    if (ms % 1'000 == 0) authority.renew(kA, t);
    receive(view, say(authority, t));
  }
  EXPECT_EQ(view.holder(t), kA);
}

TEST(AuthorityView, WithoutComparedClocksNobodyHoldsIt) {
  TwoEnds rig({.seed = 42});
  rig.clock_known = false;
  rig.run(seconds(3));
  EXPECT_EQ(rig.view.holder(rig.car_now()), 0);
  rig.clock_known = true;
  rig.run(milliseconds(100));
  EXPECT_EQ(rig.view.holder(rig.car_now()), kOperator) << "the same renewal counts once it can";
}

TEST(AuthorityView, ARunOfTheBaseThatBeginsAgainIsHeard) {
  AuthorityRegister old, reborn;
  AuthorityView view;
  const Instant t{seconds(10).ns};
  for (int i = 0; i < 9; ++i) {
    old.take(kA, t);
    old.drop(kA, t);
  }
  old.take(kA, t);
  receive(view, say(old, t));
  view.base_restarted();
  EXPECT_EQ(view.holder(t), 0);
  reborn.take(kB, t);
  receive(view, say(reborn, t));
  EXPECT_EQ(view.holder(t + milliseconds(1)), kB);
}

// Consoles, losses and restarts at random: the car never takes anyone for the holder whom the base
// does not hold, or has not held within the time that news take to come and expire.
TEST(AuthorityView, WhoHoldsInTheCarHeldAtTheBaseLessThanTheExpiryAgo) {
  std::mt19937 random(43);
  AuthorityRegister authority;
  AuthorityView view;
  std::array<Instant, 4> held_at{};
  std::vector<Statement> air;
  Instant t{seconds(10).ns};
  for (int i = 0; i < 200'000; ++i, t += milliseconds(20)) {
    const auto who = static_cast<HolderId>(1 + random() % 3);
    switch (random() % 40) {
      case 0:
        authority.take(who, t);
        break;
      case 1:
      case 2:
        authority.renew(who, t);
        break;
      case 3:
        authority.hand_over(who, static_cast<HolderId>(1 + random() % 3), t);
        break;
      case 4:
        authority.drop(who, t);
        break;
      default:
        break;
    }
    if (const HolderId now_holds = authority.holder(t); now_holds != 0) held_at[now_holds] = t;
    air.push_back(say(authority, t, milliseconds(static_cast<int>(random() % 2'000))));
    while (air.size() > 50) {
      const std::size_t pick = random() % air.size();
      Statement stated = air[pick];
      air[pick] = air.back();
      air.pop_back();
      stated.received.at = std::max(stated.received.at, t);
      if (random() % 2 == 0 && stated.received.at <= t) receive(view, stated);
    }
    if (const HolderId in_car = view.holder(t); in_car != 0) {
      ASSERT_LT(t - held_at[in_car], kAuthorityExpiry);
    }
  }
}

}  // namespace
}  // namespace pitwall::telemetry
