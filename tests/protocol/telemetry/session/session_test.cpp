// Fresh keys for a session that lives: packets go on counting, none is lost or had twice.
// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/session.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <random>
#include <set>
#include <utility>

#include "tests/protocol/telemetry/session/rig.hpp"

namespace pitwall::telemetry::testing {
namespace {

struct Link {
  double loss = 0.0;
  Duration delay = milliseconds(20), jitter{};
  std::uint32_t seed = 1;
};

// Both ends send each 20 ms; what was opened is kept.
class LivingSession {
 public:
  explicit LivingSession(const Link& link) : link_(link), random_(link.seed) { rig.establish(); }

  void run(Duration length) {
    for (const Instant end = rig.now + length; rig.now < end; rig.now += milliseconds(1)) step();
  }

  Rig rig;
  std::set<std::uint64_t> sent[2], opened[2];  // by the direction: to the base, to the car
  std::uint64_t twice = 0, new_sessions = 0;
  Instant received[2]{};
  Duration longest_silence[2]{};

 private:
  struct UnderWay {
    Instant arrives;
    Datagram datagram;
    bool to_base;
  };

  void send(const Datagram& datagram, bool to_base) {
    if (static_cast<double>(random_()) < link_.loss * 4'294'967'296.0) return;
    const Duration late = link_.jitter.ns > 0
                              ? nanoseconds(static_cast<std::int64_t>(random_()) % link_.jitter.ns)
                              : Duration{};
    air_.push_back({rig.now + link_.delay + late, datagram, to_base});
  }

  void step() {
    if (const auto due = rig.car->poll(rig.now)) send(due->first, true);
    if (const auto due = rig.base->poll(rig.now)) send(due->first, false);
    if (rig.now.ns % milliseconds(20).ns == 0) {
      send(rig.car->seal(1, rig.now), true);
      send(rig.base->seal(1, rig.now), false);
    }
    std::deque<UnderWay> later;
    for (const UnderWay& one : std::exchange(air_, {})) {
      if (one.arrives > rig.now) {
        later.push_back(one);
        continue;
      }
      const auto opened_now = one.to_base ? rig.base->feed(one.datagram, kCarAddress, rig.now)
                                          : rig.car->feed(one.datagram, kBaseAddress, rig.now);
      if (opened_now) note(*opened_now, one.to_base ? 0 : 1);
    }
    later.insert(later.end(), air_.begin(), air_.end());
    air_ = std::move(later);
  }

  void note(const Opened& packet, std::size_t direction) {
    if (!opened[direction].insert(packet.sequence).second) ++twice;
    if (packet.new_session) ++new_sessions;
    if (received[direction].ns > 0) {
      longest_silence[direction] =
          std::max(longest_silence[direction], rig.now - received[direction]);
    }
    received[direction] = rig.now;
  }

  Link link_;
  std::mt19937 random_;
  std::deque<UnderWay> air_;
};

TEST(Renewal, ComesEachTwoMinutesAndNoPacketIsLostToIt) {
  LivingSession session({});
  session.run(seconds(1'000));
  const auto& car = (*session.rig.car)->counters();
  const auto& base = (*session.rig.base)->counters();
  EXPECT_GE(car.renewals, 1'000U / 120U);
  EXPECT_EQ(car.renewals, base.renewals);
  EXPECT_EQ((*session.rig.car)->session(), 1U);
  EXPECT_EQ((*session.rig.base)->session(), 1U);
  EXPECT_EQ(session.new_sessions + session.twice, 0U);
  for (const std::size_t direction : {0U, 1U}) {
    EXPECT_LE(session.longest_silence[direction], milliseconds(20)) << direction;
    // Each number up to the newest came.
    EXPECT_EQ(session.opened[direction].size(), *session.opened[direction].rbegin() - 1);
  }
}

TEST(Renewal, ThroughLossJitterAndSecondsOfDelayCountsEachPacketOnce) {
  for (const Link link :
       {Link{.loss = 0.5}, Link{.delay = milliseconds(5), .jitter = milliseconds(300)},
        Link{.loss = 0.3, .delay = milliseconds(1'500), .jitter = seconds(1)}}) {
    for (const std::uint32_t seed : {1U, 2U}) {
      Link seeded = link;
      seeded.seed = seed;
      LivingSession session(seeded);
      session.run(seconds(300));
      EXPECT_GE((*session.rig.car)->counters().renewals, 2U);
      EXPECT_GE((*session.rig.base)->counters().renewals, 2U);
      EXPECT_EQ(session.twice + session.new_sessions, 0U);
      EXPECT_EQ((*session.rig.car)->session(), 1U);
      // Nothing but the loss of the link: 15,000 packets each way.
      for (const std::size_t direction : {0U, 1U}) {
        EXPECT_GE(static_cast<double>(session.opened[direction].size()),
                  15'000.0 * (1.0 - link.loss) * 0.97)
            << direction << ' ' << seed;
      }
    }
  }
}

TEST(Renewal, KeysAreNeverOlderThanTwoMinutesWhileHalfOfAllIsLost) {
  LivingSession session({.loss = 0.5});
  std::uint64_t renewals = 0;
  Instant since = session.rig.now;
  for (int i = 0; i < 3'000; ++i) {
    session.run(milliseconds(100));
    if ((*session.rig.base)->counters().renewals == renewals) {
      EXPECT_LE(session.rig.now - since, seconds(120));
      continue;
    }
    renewals = (*session.rig.base)->counters().renewals;
    since = session.rig.now;
  }
}

TEST(Renewal, TheKeysBeforeOpenNothingAfterTheirTime) {
  LivingSession session({});
  session.run(kRenewAfter - seconds(1));
  const Datagram late = session.rig.car->seal(1, session.rig.now);
  const Datagram later = session.rig.car->seal(1, session.rig.now);
  session.run(seconds(2));
  ASSERT_EQ((*session.rig.base)->counters().renewals, 1U);
  EXPECT_TRUE(session.rig.base->feed(late, kCarAddress, session.rig.now));
  EXPECT_FALSE(session.rig.base->feed(late, kCarAddress, session.rig.now)) << "once";
  session.run(kOldSessionKept);
  EXPECT_FALSE(session.rig.base->feed(later, kCarAddress, session.rig.now));
}

// A spare base with the same keys knows nothing of the numbers; nor does the first one go on when
// the car comes back to it.
TEST(Renewal, WithABaseThatHasNoPartInTheSessionANewOneBegins) {
  Rig rig;
  rig.establish();
  for (std::uint32_t i = 0; i < 5'000; ++i) {
    ASSERT_TRUE(rig.base->feed(rig.car->seal(i, rig.now), kCarAddress, rig.now));
    ASSERT_TRUE(rig.car->feed(rig.base->seal(i, rig.now), kBaseAddress, rig.now));
  }
  End spare(rig.keys.base, 20);
  rig.now += kSilenceOpens;
  establish(*rig.car, spare, rig.now);
  EXPECT_EQ((*rig.car)->session(), 2U);
  rig.now += kSilenceOpens;
  establish(*rig.car, *rig.base, rig.now);
  EXPECT_EQ((*rig.car)->session(), 3U);
  EXPECT_EQ((*rig.base)->session(), 2U);
  EXPECT_EQ((*rig.car)->counters().renewals, 0U);
}

}  // namespace
}  // namespace pitwall::telemetry::testing
