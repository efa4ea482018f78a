// SPDX-License-Identifier: Apache-2.0
#include "basestation/alarms/notices.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace pitwall::alarms {
namespace {

using state::LinkState;

struct BenchServer {
  Notices notices;
  Instant now{seconds(100).ns};

  void run(Duration length, LinkState state, double loss = 0.0, double round_trip_ms = 20.0,
           Duration silence = milliseconds(20)) {
    for (const Instant end = now + length; now < end; now += milliseconds(10)) {
      notices.step({state, silence, loss, round_trip_ms, "driving"}, now);
    }
  }
  std::vector<NoticeKind> kinds() const {
    std::vector<NoticeKind> kinds;
    for (const Notice& notice : notices.all()) kinds.push_back(notice.kind);
    return kinds;
  }
};

using enum NoticeKind;
using Kinds = std::vector<NoticeKind>;

TEST(Notices, AMereDelayIsToldAsOne) {
  BenchServer authority;
  authority.run(seconds(5), LinkState::kGood);
  EXPECT_TRUE(authority.notices.all().empty());
  authority.run(seconds(4), LinkState::kDegraded, 0.34, 210.0);
  authority.run(seconds(5), LinkState::kGood);
  ASSERT_EQ(authority.kinds(), (Kinds{kDegraded, kRestored}));
  EXPECT_EQ(authority.notices.all()[0].text,
            "Radio to our car is degraded, not lost. Car: driving. It hears us and drives on; no "
            "action is asked.");
  EXPECT_EQ(authority.notices.all()[0].evidence, "silence 0.02 s, loss 34 %, round trip 210 ms");
  EXPECT_EQ(authority.notices.all()[1].text,
            "Radio to our car is good again after 4.0 s. Car: driving.");
  EXPECT_EQ(authority.notices.all()[1].evidence,
            "was degraded, never lost; longest silence 0.02 s, worst loss 34 %, longest round "
            "trip 210 ms");
}

TEST(Notices, ALossIsOneMessageToo) {
  BenchServer authority;
  authority.run(seconds(1), LinkState::kGood);
  authority.run(seconds(1), LinkState::kDegraded, 0.2);
  authority.run(seconds(3), LinkState::kLost, 1.0, 20.0, seconds(1));
  authority.run(seconds(1), LinkState::kDegraded, 0.5);
  authority.run(seconds(1), LinkState::kLost, 1.0, 20.0, seconds(2));
  ASSERT_EQ(authority.kinds(), (Kinds{kDegraded}));
  EXPECT_EQ(authority.notices.all()[0].text,
            "Radio to our car is lost. Car, when last heard: driving. If the silence lasts it "
            "makes a controlled stop by itself.");
  authority.run(seconds(3), LinkState::kGood);
  EXPECT_EQ(authority.kinds(), (Kinds{kDegraded, kRestored}));
}

TEST(Notices, WhatWasSentStaysWhatItSaid) {
  BenchServer authority;
  authority.run(seconds(1), LinkState::kDegraded, 0.2);
  const std::string output = authority.notices.all()[0].text;
  EXPECT_FALSE(authority.notices.decide(1, NoticeFate::kReported, ""));
  EXPECT_TRUE(authority.notices.decide(1, NoticeFate::kReported, "Ada"));
  EXPECT_FALSE(authority.notices.decide(1, NoticeFate::kDismissed, "Ada"));
  EXPECT_FALSE(authority.notices.decide(2, NoticeFate::kReported, "Ada"));
  authority.run(seconds(1), LinkState::kLost, 1.0);
  EXPECT_EQ(authority.notices.all()[0].text, output);
  EXPECT_EQ(authority.kinds().size(), 1U);
}

// However the link flutters: degraded and restored take turns, beginning with degraded.
TEST(Notices, EachExactlyOnceInTurn) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    std::mt19937 random{seed};
    BenchServer authority;
    for (int i = 0; i < 60; ++i) {
      authority.run(milliseconds(100 + static_cast<std::int64_t>(random() % 4'000)),
                    static_cast<LinkState>(random() % 4));
    }
    authority.run(seconds(3), LinkState::kGood);
    NoticeKind expected = kDegraded;
    for (const NoticeKind kind : authority.kinds()) {
      EXPECT_EQ(kind, expected) << seed;
      expected = kind == kDegraded ? kRestored : kDegraded;
    }
    EXPECT_EQ(expected, kDegraded) << "the last was restored, seed " << seed;
  }
}

TEST(Notices, ACarThatWasNeverHeardIsNoMessage) {
  BenchServer authority;
  authority.run(seconds(60), LinkState::kNone);
  EXPECT_TRUE(authority.notices.all().empty());
}

}  // namespace
}  // namespace pitwall::alarms
