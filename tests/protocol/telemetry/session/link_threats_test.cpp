// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/link_threats.hpp"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "protocol/telemetry/registry/labels.hpp"
#include "protocol/vocabulary/units.hpp"
#include "tests/support/allocation_guard.hpp"

namespace pitwall::telemetry {
namespace {

constexpr Duration kTick = milliseconds(20);

// The counters of an end with two radios, as time passes.
class Threats : public ::testing::Test {
 protected:
  // `each` is called every kTick, before the monitor's step.
  void run(Duration length, const std::function<void()>& each = {}) {
    for (const Instant end = now_ + length; now_ < end;) {
      now_ = now_ + kTick;
      if (each) each();
      monitor_.step(counters_, now_);
      while (const auto change = monitor_.next_change()) changes_.push_back(*change);
    }
  }
  // So many a second, evenly.
  std::function<void()> at_rate(std::uint64_t& counter, double per_s) {
    return [&counter, per_s, owed = 0.0]() mutable {
      owed += per_s * kTick.seconds();
      const auto whole = static_cast<std::uint64_t>(owed);
      counter += whole;
      owed -= static_cast<double>(whole);
    };
  }
  std::uint64_t& refused(Refusal why) { return counters_.refused[static_cast<std::size_t>(why)]; }
  // 50 packets a second by each of two paths, so every other packet is a copy.
  void receive() {
    ++counters_.opened;
    ++refused(Refusal::kReplayed);
    ++counters_.duplicates;
  }
  // A session that is heard, and old.
  void settle() {
    counters_.exchanges = 1;
    run(kThreatSettled + seconds(1), [this] { receive(); });
    ASSERT_TRUE(monitor_.active().empty());
  }
  // How long the attack takes to be seen; zero: not within 5 s.
  Duration seen_after(Threat threat, const std::function<void()>& attack) {
    const Instant begin = now_;
    while (!monitor_.active().has(threat) && now_ - begin < seconds(5)) run(kTick, attack);
    return monitor_.active().has(threat) ? now_ - begin : Duration{};
  }

  ThreatMonitor monitor_{Role::kBase, 2};
  AssociationCounters counters_;
  Instant now_{seconds(1'000).ns};
  std::vector<ThreatChange> changes_;
};

ThreatSet only(Threat threat) {
  ThreatSet set;
  set.set(threat, true);
  return set;
}

TEST_F(Threats, HaveTheNamesOfTheRegistry) {
  std::size_t names = 0;
  while (!label_at(kThreatNames, names).empty()) ++names;
  EXPECT_EQ(names, kThreats);
  EXPECT_EQ(text_of(Threat::kWrongKey), "wrong key");
  EXPECT_EQ(text_of(Threat::kRelay), "relay");
}

TEST(ThreatSet, OfAFieldIsNoneWhereThatIsNotKnown) {
  EXPECT_EQ(threats_of(0.0), ThreatSet{});
  EXPECT_EQ(threats_of(32.0), only(Threat::kRelay));
  for (const double none : {kUnset, -1.0, 1e9}) EXPECT_TRUE(threats_of(none).empty());
}

TEST(ThreatLine, SaysWhichEndSeesWhat) {
  std::array<char, kThreatLine> text{};
  ThreatChange change{.threat = Threat::kWrongKey};
  EXPECT_EQ(write_line(change, false, text),
            "radio, seen by the car: Key exchange messages do not fit our keys");
  change = {.threat = Threat::kRefusedAtRate, .begins = false, .most_per_s = 4'294'967'295U};
  EXPECT_EQ(write_line(change, true, text),
            "radio, seen by the base: over, at most 4294967295/s: "
            "Forged or foreign datagrams come at rate; all are refused");
  for (std::size_t i = 0; i < kThreats; ++i) {
    change.threat = static_cast<Threat>(i);
    EXPECT_TRUE(write_line(change, true, text).ends_with(describe(change.threat)));
  }
}

// An opening of the wrong end comes each half a second on a path that is one of several addresses.
TEST_F(Threats, AnEndWithAnotherKeyKnocksFourTimesAndIsSeen) {
  ++refused(Refusal::kBadExchange);
  const Duration seen = seen_after(Threat::kWrongKey, at_rate(refused(Refusal::kBadExchange), 2.0));
  EXPECT_GT(seen, Duration{});
  EXPECT_LE(seen, seconds(2));
  EXPECT_EQ(monitor_.active(), only(Threat::kWrongKey));
}

TEST_F(Threats, SealedAgainstSignedIsSeenByTheSecondAttempt) {
  ++refused(Refusal::kWrongMode);
  run(seconds(1));
  EXPECT_TRUE(monitor_.active().empty()) << "one may be a spoiled byte";
  ++refused(Refusal::kWrongMode);
  run(kThreatSample);
  EXPECT_EQ(monitor_.active(), only(Threat::kModeMismatch));
  // The attempts come more seldom, eight seconds apart in the end.
  for (int i = 0; i < 5; ++i) {
    run(seconds(8));
    EXPECT_EQ(monitor_.active(), only(Threat::kModeMismatch));
    ++refused(Refusal::kWrongMode);
  }
}

TEST_F(Threats, WhatNoHonestNetworkSendsIsSeenFromFiftyASecondOn) {
  for (const Refusal why : {Refusal::kHeader, Refusal::kForged, Refusal::kReplayed}) {
    const Duration seen = seen_after(Threat::kRefusedAtRate, at_rate(refused(why), 60.0));
    EXPECT_GT(seen, Duration{}) << text_of(why);
    EXPECT_LE(seen, seconds(2)) << text_of(why);
    EXPECT_EQ(monitor_.active(), only(Threat::kRefusedAtRate));
    run(kThreatHold + 2 * kThreatWindow);
    EXPECT_TRUE(monitor_.active().empty());
  }
}

TEST_F(Threats, PacketsOfTheSessionBeforeAreExpectedAfterARestartOnly) {
  const auto stray = at_rate(refused(Refusal::kNoSession), 400.0);
  run(seconds(5), stray);
  EXPECT_TRUE(monitor_.active().empty()) << "no session";
  counters_.exchanges = 1;
  run(seconds(5), [&] { receive(), stray(); });
  EXPECT_TRUE(monitor_.active().empty()) << "a young session";
  settle();
  EXPECT_GT(seen_after(Threat::kRefusedAtRate, [&] { receive(), stray(); }), Duration{});
}

TEST_F(Threats, AFloodIsSeenAtOnceWhateverTheSession) {
  for (const Refusal why : {Refusal::kNoSession, Refusal::kOldExchange, Refusal::kForeignBoot}) {
    const Duration seen = seen_after(Threat::kRefusedAtRate, at_rate(refused(why), 50'000.0));
    EXPECT_GT(seen, Duration{}) << text_of(why);
    EXPECT_LE(seen, milliseconds(200)) << text_of(why);
    run(kThreatHold + 2 * kThreatWindow);
  }
}

TEST_F(Threats, CopiesAreOneByEachPathAndOneOfTheNetworkForEach) {
  settle();
  run(seconds(20), [this] {
    receive();
    counters_.duplicates += 2;
    refused(Refusal::kReplayed) += 2;
  });
  EXPECT_TRUE(monitor_.active().empty());
  const Duration seen = seen_after(Threat::kRefusedAtRate, [this] {
    receive();
    counters_.duplicates += 8;
    refused(Refusal::kReplayed) += 8;
  });
  EXPECT_GT(seen, Duration{});
  EXPECT_LE(seen, seconds(1));
}

// A path that is silent beside a good one: its openings are copied by the network.
TEST_F(Threats, OpeningsThatTheNetworkCopiesAreNone) {
  settle();
  run(seconds(20), [this, tick = 0]() mutable {
    receive();
    if (++tick % 5 == 0) ++refused(Refusal::kOldStamp), ++refused(Refusal::kOldExchange);
    if (tick % 200 == 0) ++counters_.relayed;
  });
  EXPECT_TRUE(changes_.empty());
}

// Both paths are silent, one of them the slower: each second opening is overtaken, all are copied.
TEST_F(Threats, OpeningsWithoutASessionAreNone) {
  run(seconds(20), at_rate(refused(Refusal::kOldStamp), 40.0));
  EXPECT_TRUE(changes_.empty());
}

// A car whose clock is back, and replies to its openings that come late.
TEST_F(Threats, ThreeRepliesToAnOldOpeningAreNone) {
  refused(Refusal::kBadExchange) += 3;
  run(seconds(20));
  EXPECT_TRUE(changes_.empty());
}

TEST_F(Threats, ReplayedOpeningsAreSeenBesideASessionAndWithoutOne) {
  const auto attack = at_rate(refused(Refusal::kOldStamp), 100.0);
  Duration seen = seen_after(Threat::kReplayedOpenings, attack);
  EXPECT_GT(seen, Duration{});
  EXPECT_LE(seen, seconds(2));
  run(kThreatHold + 2 * kThreatWindow);
  settle();
  seen = seen_after(Threat::kReplayedOpenings, [&] { receive(), attack(); });
  EXPECT_GT(seen, Duration{});
  EXPECT_LE(seen, milliseconds(500));
  EXPECT_EQ(monitor_.active(), only(Threat::kReplayedOpenings));
}

TEST_F(Threats, ARelayIsSeen) {
  settle();
  const Duration seen = seen_after(Threat::kRelay, at_rate(counters_.relayed, 25.0));
  EXPECT_GT(seen, Duration{});
  EXPECT_LE(seen, seconds(1));
}

// The base: two cars with one key take the session from each other, each quarter of a second.
TEST_F(Threats, ASecondPeerThatTakesTurnsIsSeen) {
  settle();
  const Duration seen = seen_after(Threat::kSecondPeer, [this, tick = 0]() mutable {
    receive();
    if (tick % 12 == 0) ++counters_.second_peers;
    if (tick++ % 12 == 3) ++counters_.exchanges;
  });
  EXPECT_GT(seen, Duration{});
  EXPECT_LE(seen, seconds(1));
}

// One that gets no session, while ours is heard.
TEST_F(Threats, ASecondPeerThatOnlyKnocksIsSeen) {
  settle();
  const auto knocks = at_rate(counters_.second_peers, 2.0);
  const Duration seen = seen_after(Threat::kSecondPeer, [&] { receive(), knocks(); });
  EXPECT_GT(seen, Duration{});
  EXPECT_LE(seen, seconds(2));
}

// It comes with the answer of ours, and once only.
TEST_F(Threats, ASecondAnswerIsSeenByTheCar) {
  monitor_ = ThreatMonitor(Role::kCar, 2);
  const Duration seen = seen_after(Threat::kSecondPeer, [this, once = false]() mutable {
    receive();
    if (!once) once = true, ++counters_.exchanges, ++counters_.second_peers;
  });
  EXPECT_GT(seen, Duration{});
  EXPECT_LE(seen, milliseconds(200));
}

// Its openings are those of another process for as long as the one before counts as heard.
TEST_F(Threats, ARestartOfThePeerIsNone) {
  for (const int openings : {1, 4, 10, 20}) {
    settle();
    run(seconds(1), at_rate(counters_.second_peers, openings));
    ++counters_.exchanges;
    run(seconds(20), [this] { receive(); });
    EXPECT_TRUE(changes_.empty()) << openings;
  }
}

TEST_F(Threats, AFloodIsOneChangeAndItsEndAnother) {
  run(seconds(60), at_rate(refused(Refusal::kForged), 50'000.0));
  ASSERT_EQ(changes_.size(), 1U);
  EXPECT_EQ(changes_[0].threat, Threat::kRefusedAtRate);
  EXPECT_TRUE(changes_[0].begins);
  EXPECT_LE(changes_[0].at, Instant{seconds(1'000).ns} + milliseconds(200));
  run(kThreatHold + 2 * kThreatWindow);
  ASSERT_EQ(changes_.size(), 2U);
  EXPECT_FALSE(changes_[1].begins);
  EXPECT_NEAR(changes_[1].most_per_s, 50'000.0, 500.0);
}

// A second of flood and some seconds of quiet, for two minutes: at most one change in kThreatHold.
TEST_F(Threats, AFloodThatComesAndGoesIsNotToldMoreOften) {
  for (const Duration quiet : {seconds(3), seconds(11), seconds(13)}) {
    changes_.clear();
    for (const Instant end = now_ + seconds(120); now_ < end;) {
      run(seconds(1), at_rate(refused(Refusal::kForged), 50'000.0));
      run(quiet);
    }
    for (std::size_t i = 1; i < changes_.size(); ++i) {
      EXPECT_NE(changes_[i].begins, changes_[i - 1].begins);
    }
    EXPECT_LE(changes_.size(), static_cast<std::size_t>(seconds(120) / kThreatHold) + 1);
    run(2 * kThreatHold + kThreatWindow);
  }
}

TEST_F(Threats, ItEndsTenSecondsAfterTheLast) {
  run(seconds(2), at_rate(refused(Refusal::kForged), 500.0));
  const Instant end = now_;
  while (!monitor_.active().empty() && now_ - end < seconds(60)) run(kTick);
  EXPECT_GE(now_ - end, kThreatHold);
  EXPECT_LE(now_ - end, kThreatHold + kThreatWindow + 2 * kThreatSample);
}

TEST_F(Threats, NothingIsAllocated) {
  const std::uint64_t allocations = pitwall::testing::allocations_of([this] {
    for (int i = 0; i < 1'000; ++i) {
      now_ = now_ + kTick;
      refused(Refusal::kForged) += 1'000;
      monitor_.step(counters_, now_);
      static_cast<void>(monitor_.next_change());
    }
  });
  EXPECT_EQ(allocations, 0U);
}

}  // namespace
}  // namespace pitwall::telemetry
