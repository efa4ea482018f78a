// Openings that a base takes: fresh ones, copies, replays of yesterday, before and after restarts.
// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/responder.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/protocol/telemetry/session/rig.hpp"

namespace pitwall::telemetry::testing {
namespace {

// Openings of a car that nobody answered, 100 ms apart, the oldest first.
std::vector<Datagram> recorded(const KeyPair& keys, int count, Instant from) {
  std::vector<Datagram> openings;
  End car(keys.car, 1);
  for (int i = 0; i < count; ++i) openings.push_back(car.poll(from + kRetry * i)->first);
  return openings;
}

TEST(Responder, OfOneStampTwoSourcesAreAnsweredAndEachOnce) {
  Rig rig;
  const Datagram opening = rig.car->poll(rig.now)->first;
  const UdpAddress third{.ip = 3, .port = 3};
  int answers = 0;
  for (const UdpAddress from : {kElsewhere, kElsewhere, kCarAddress, third, kCarAddress, third}) {
    rig.base->feed(opening, from, rig.now);
    if (const auto answer = rig.base->poll(rig.now)) {
      ++answers;
      EXPECT_EQ(answer->second, answers == 1 ? kElsewhere : kCarAddress);
    }
  }
  EXPECT_EQ(answers, 2);
  EXPECT_EQ(rig.base->refused(Refusal::kOldStamp), 4U);
}

TEST(Responder, ARecordedOpeningIsRefusedAfterItsSessionAndAfterARestartThatRemembers) {
  Rig rig;
  const Datagram opening = rig.car->poll(rig.now)->first;
  rig.base->feed(opening, kCarAddress, rig.now);
  rig.car->feed(rig.base->poll(rig.now)->first, kBaseAddress, rig.now);
  ASSERT_TRUE(rig.base->feed(rig.car->seal(1, rig.now), kCarAddress, rig.now));
  rig.base->feed(opening, kElsewhere, rig.now + seconds(5));
  EXPECT_EQ(rig.base->refused(Refusal::kOldStamp), 0U)
      << "a second source may be the car's other way";
  rig.base->feed(opening, UdpAddress{.ip = 4, .port = 4}, rig.now + seconds(5));
  EXPECT_EQ(rig.base->refused(Refusal::kOldStamp), 1U);
  End restarted(rig.keys.base, 13, {.newest_stamp = (*rig.base)->newest_stamp()});
  restarted.feed(opening, kElsewhere, rig.now + seconds(6));
  EXPECT_EQ(restarted.refused(Refusal::kOldStamp), 1U);
  EXPECT_FALSE(restarted.poll(rig.now + seconds(6)));
}

// A new disk, a spare base: what it cannot know costs it a bounded number of key agreements.
TEST(Responder, WithoutMemoryReplaysCostTheirRateAndTheCarComesInAtOnce) {
  const KeyPair keys = make_pair(1);
  const auto old = recorded(keys, 1'000, Instant{seconds(10).ns});
  End base(keys.base, 2);
  Instant now{seconds(1'000).ns};
  int answers = 0;
  for (std::size_t i = 0; i < 10'000; ++i, now += microseconds(100)) {
    base.feed(old[i % old.size()], UdpAddress{.ip = static_cast<std::uint32_t>(i), .port = 9}, now);
    while (base.poll(now)) ++answers;
  }
  // In one second each limit gives what it saved and what it earns.
  EXPECT_LE(answers, Responder::kAnswersAtOnce + Responder::kAnswersPerSecond + 1 +
                         2 * Responder::kStampRepliesPerSecond + 1);
  EXPECT_GT(base.refused(Refusal::kOldStamp), 8'900U);
  End car(keys.car, 3);
  establish(car, base, now);
  EXPECT_TRUE(base->ready());
}

// The newest is worked on first: replays in rising order do not keep the car waiting.
TEST(Responder, TheCarOvertakesReplaysThatWait) {
  const KeyPair keys = make_pair(1);
  const auto old = recorded(keys, 200, Instant{seconds(10).ns});
  End base(keys.base, 2), car(keys.car, 3);
  Instant now{seconds(1'000).ns};
  for (const Datagram& datagram : old) base.feed(datagram, kElsewhere, now);
  while (base.poll(now)) continue;
  base.feed(car.poll(now)->first, kCarAddress, now);
  now += milliseconds(51);  // one agreement's time
  const auto answer = base.poll(now);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->second, kCarAddress);
  car.feed(answer->first, kBaseAddress, now);
  EXPECT_TRUE(car->ready());
}

TEST(Responder, ACarWhoseClockWentBackIsToldWhatToExceed) {
  for (const std::int64_t back_s : {2LL, 3'600LL, 1'700'000'000LL}) {
    const KeyPair keys = make_pair(1);
    Instant now{seconds(100).ns};
    End base(keys.base, 2), before(keys.car, 3, {.to_utc = seconds(2'000'000'000)});
    establish(before, base, now);
    now += seconds(10);
    End car(keys.car, 4, {.to_utc = seconds(2'000'000'000 - 10 - back_s)});
    const auto opening = car.poll(now);
    base.feed(opening->first, kCarAddress, now);
    const auto reported = base.poll(now);
    ASSERT_TRUE(reported) << back_s;
    EXPECT_EQ(parse_header(reported->first)->kind, Kind::kNewerStamp);
    EXPECT_LT(reported->first.size(), opening->first.size()) << "amplifies nothing";
    EXPECT_EQ(reported->second, kCarAddress);
    car.feed(reported->first, kBaseAddress, now);
    establish(car, base, now);
    EXPECT_EQ(base->session(), 2U);
  }
}

// ... also while a thousand recorded ones come from everywhere.
TEST(Responder, ACarWhoseClockWentBackComesInThroughAFlood) {
  const KeyPair keys = make_pair(1);
  const auto old = recorded(keys, 1'000, Instant{seconds(10'000).ns});
  End base(keys.base, 2), car(keys.car, 3);
  Instant now{seconds(1'000).ns};
  for (std::uint32_t i = 0; i < 50'000 && !base->ready(); ++i, now += microseconds(100)) {
    base.feed(old[i % old.size()], UdpAddress{.ip = i % 5'000, .port = 9}, now);
    if (i % 10 != 0) continue;  // each millisecond
    if (const auto opening = car.poll(now)) base.feed(opening->first, kCarAddress, now);
    while (const auto reply = base.poll(now)) {
      if (reply->second == kCarAddress) car.feed(reply->first, kBaseAddress, now);
    }
    if (const Datagram packet = car.seal(1, now); !packet.empty()) {
      base.feed(packet, kCarAddress, now);
    }
  }
  EXPECT_TRUE(base->ready());
  EXPECT_LT((now - Instant{seconds(1'000).ns}).seconds(), 5.0);
}

// A car was started twice: what the first one still has under way confirms nothing any more.
TEST(Responder, AProcessThatOpensLaterEndsWhatAnEarlierOneOpened) {
  Rig rig;
  End first(rig.keys.car, 21), second(rig.keys.car, 22);
  exchange(first, *rig.base, rig.now);
  const Datagram late = first.seal(1, rig.now);
  exchange(second, *rig.base, rig.now);
  EXPECT_FALSE(rig.base->feed(late, kCarAddress, rig.now));
  EXPECT_TRUE(rig.base->feed(second.seal(1, rig.now), kCarAddress, rig.now));
  EXPECT_EQ((*rig.base)->peer()->boot, 22U);
}

TEST(Responder, WhatWaitsForItsFirstPacketExpires) {
  for (const bool late : {false, true}) {
    Rig rig;
    exchange(*rig.car, *rig.base, rig.now);
    const Instant then = rig.now + Responder::kPendingLife + (late ? Duration{} : nanoseconds(-1));
    EXPECT_EQ(rig.base->feed(rig.car->seal(1, then), kCarAddress, then).has_value(), !late);
  }
}

TEST(Responder, ARecordedStampBeforeItTellsNobodyMoreThanTheLimits) {
  const KeyPair keys = make_pair(1);
  const auto old = recorded(keys, 1'000, Instant{seconds(10).ns});
  End base(keys.base, 2, {.newest_stamp = static_cast<Stamp>(seconds(5'000).ns)});
  Instant now{seconds(1'000).ns};
  std::uint64_t replies = 0, to_one = 0;
  for (std::size_t i = 0; i < 100'000; ++i, now += microseconds(100)) {
    const bool one = i % 2 == 0;
    const UdpAddress from =
        one ? kElsewhere : UdpAddress{.ip = static_cast<std::uint32_t>(i), .port = 1};
    base.feed(old[i % old.size()], from, now);
    while (const auto reply = base.poll(now)) {
      ++replies;
      to_one += reply->second == kElsewhere ? 1U : 0U;
    }
  }
  EXPECT_LE(replies, 11U * Responder::kStampRepliesPerSecond);
  EXPECT_LE(to_one, 11U * Responder::kStampRepliesPerSource);
}

}  // namespace
}  // namespace pitwall::telemetry::testing
