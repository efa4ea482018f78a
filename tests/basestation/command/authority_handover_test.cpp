// SPDX-License-Identifier: Apache-2.0
#include "basestation/command/authority_handover.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/basestation/command/people.hpp"

namespace pitwall::command {
namespace {

struct AuthorityPit {
  telemetry::AuthorityRegister authority;
  Audit audit;
  AuthorityHandover talk{authority, audit};
  Instant now{seconds(100).ns};

  // The holder renews each second, as his console does.
  void run(Duration length, const Person* renewing = nullptr) {
    for (const Instant end = now + length; now < end;) {
      now += milliseconds(100);
      const bool due = now.ns % seconds(1).ns == 0;
      if (due && renewing != nullptr) (void)talk.renew(*renewing, now);
      talk.advance(now);
    }
  }
};

TEST(AuthorityHandover, AFreeOneIsTakenAtOnce) {
  AuthorityPit pit;
  EXPECT_TRUE(pit.talk.take(kAda, pit.now));
  EXPECT_FALSE(pit.talk.take(kBob, pit.now));
  EXPECT_EQ(pit.talk.holder(pit.now), kAda.console);
  EXPECT_EQ(pit.talk.holder_person(), kAda);
  EXPECT_TRUE(pit.talk.take(kAda, pit.now));  // renews
}

TEST(AuthorityHandover, SilenceGrantsAfterFiveSeconds) {
  AuthorityPit pit;
  ASSERT_TRUE(pit.talk.take(kAda, pit.now));
  ASSERT_TRUE(pit.talk.request(kBob, pit.now));
  pit.run(milliseconds(4'900), &kAda);
  EXPECT_EQ(pit.talk.holder(pit.now), kAda.console);
  pit.run(milliseconds(200), &kAda);
  EXPECT_EQ(pit.talk.holder(pit.now), kBob.console);
  EXPECT_EQ(pit.talk.holder_person(), kBob);
  EXPECT_FALSE(pit.talk.waiting());
}

TEST(AuthorityHandover, GrantedAtOnceRefusedForGood) {
  AuthorityPit pit;
  ASSERT_TRUE(pit.talk.take(kAda, pit.now));
  EXPECT_FALSE(pit.talk.grant(kAda, pit.now));  // nobody asks
  ASSERT_TRUE(pit.talk.request(kBob, pit.now));
  EXPECT_FALSE(pit.talk.grant(kBob, pit.now));  // not his to grant
  EXPECT_FALSE(pit.talk.refuse(kEve, pit.now));
  ASSERT_TRUE(pit.talk.refuse(kAda, pit.now));
  pit.run(seconds(10), &kAda);
  EXPECT_EQ(pit.talk.holder(pit.now), kAda.console);
  ASSERT_TRUE(pit.talk.request(kBob, pit.now));
  ASSERT_TRUE(pit.talk.grant(kAda, pit.now));
  EXPECT_EQ(pit.talk.holder(pit.now), kBob.console);
}

TEST(AuthorityHandover, OneAsksAtATimeAndAskingTwiceGainsNoTime) {
  AuthorityPit pit;
  ASSERT_TRUE(pit.talk.take(kAda, pit.now));
  EXPECT_FALSE(pit.talk.request(kAda, pit.now));
  ASSERT_TRUE(pit.talk.request(kBob, pit.now));
  const Instant until = pit.talk.waiting()->until;
  pit.run(seconds(2), &kAda);
  EXPECT_FALSE(pit.talk.request(kEve, pit.now));
  ASSERT_TRUE(pit.talk.request(kBob, pit.now));
  EXPECT_EQ(pit.talk.waiting()->until, until);
}

TEST(AuthorityHandover, AFrozenHolderGivesWayWhenItExpires) {
  AuthorityPit pit;
  ASSERT_TRUE(pit.talk.take(kAda, pit.now));
  ASSERT_TRUE(pit.talk.request(kBob, pit.now));
  pit.run(milliseconds(3'100));  // Ada's console stands still
  EXPECT_EQ(pit.talk.holder(pit.now), kBob.console);
}

TEST(AuthorityHandover, ExpiryIsALossADropIsNot) {
  AuthorityPit pit;
  ASSERT_TRUE(pit.talk.take(kAda, pit.now));
  pit.run(seconds(4));
  EXPECT_TRUE(pit.talk.lost());
  EXPECT_EQ(pit.talk.holder_person(), Person{});
  ASSERT_TRUE(pit.talk.take(kBob, pit.now));
  EXPECT_FALSE(pit.talk.lost());
  ASSERT_TRUE(pit.talk.drop(kBob, pit.now));
  pit.run(seconds(4));
  EXPECT_FALSE(pit.talk.lost());
  EXPECT_FALSE(pit.talk.drop(kBob, pit.now));
}

TEST(AuthorityHandover, WhoDropsGivesToTheOneWhoWaits) {
  AuthorityPit pit;
  ASSERT_TRUE(pit.talk.take(kAda, pit.now));
  ASSERT_TRUE(pit.talk.request(kBob, pit.now));
  ASSERT_TRUE(pit.talk.drop(kAda, pit.now));
  EXPECT_EQ(pit.talk.holder(pit.now), kBob.console);
}

TEST(AuthorityHandover, AConsoleThatLeftAsksNoMore) {
  AuthorityPit pit;
  ASSERT_TRUE(pit.talk.take(kAda, pit.now));
  ASSERT_TRUE(pit.talk.request(kBob, pit.now));
  pit.talk.left(kBob, pit.now);
  pit.run(seconds(10), &kAda);
  EXPECT_EQ(pit.talk.holder(pit.now), kAda.console);
}

// Any order of acts: one holder, the one that is named; a request never waits longer than it may.
TEST(AuthorityHandover, AnyOrderOfActs) {
  const std::vector<Person> people{kAda, kBob, kEve};
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random{seed};
    AuthorityPit pit;
    for (int i = 0; i < 300; ++i) {
      const Person& who = people[random() % people.size()];
      switch (random() % 8) {
        case 0:
          (void)pit.talk.take(who, pit.now);
          break;
        case 1:
          (void)pit.talk.drop(who, pit.now);
          break;
        case 2:
          (void)pit.talk.request(who, pit.now);
          break;
        case 3:
          (void)pit.talk.grant(who, pit.now);
          break;
        case 4:
          (void)pit.talk.refuse(who, pit.now);
          break;
        case 5:
          pit.talk.left(who, pit.now);
          break;
        default:
          (void)pit.talk.renew(who, pit.now);
      }
      pit.run(milliseconds(100 * static_cast<std::int64_t>(random() % 15)));
      const auto holder = pit.talk.holder(pit.now);
      ASSERT_EQ(pit.talk.holder_person().console, holder);
      if (pit.talk.waiting()) {
        ASSERT_LT(pit.now, pit.talk.waiting()->until);
        ASSERT_NE(pit.talk.waiting()->by.console, holder);
      }
    }
  }
}

}  // namespace
}  // namespace pitwall::command
