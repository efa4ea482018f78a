// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/association.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "tests/protocol/telemetry/session/rig.hpp"
#include "tests/support/allocation_guard.hpp"

namespace pitwall::telemetry::testing {
namespace {

TEST(Association, OneExchangeAndThePacketsGoBothWays) {
  Rig rig;
  EXPECT_FALSE(rig.base->feed(Datagram{}, kCarAddress, rig.now));
  EXPECT_FALSE((*rig.car)->ready());
  exchange(*rig.car, *rig.base, rig.now);
  EXPECT_TRUE((*rig.car)->ready());
  EXPECT_FALSE((*rig.base)->ready()) << "not before the car showed that it has the keys";
  const auto first = rig.base->feed(rig.car->seal(77, rig.now), kCarAddress, rig.now);
  ASSERT_TRUE(first);
  EXPECT_TRUE(first->new_session && first->newest);
  EXPECT_EQ(first->sequence, 1U);
  EXPECT_EQ(first->body.size(), 64U);
  EXPECT_EQ(first->body[0], 77);
  EXPECT_TRUE((*rig.base)->ready());
  ASSERT_TRUE((*rig.base)->peer());
  EXPECT_EQ((*rig.base)->peer()->boot, 11U);
  EXPECT_EQ((*rig.car)->peer()->boot, 12U);
  const auto second = rig.base->feed(rig.car->seal(78, rig.now), kCarAddress, rig.now);
  ASSERT_TRUE(second);
  EXPECT_FALSE(second->new_session);
}

TEST(Association, ALostMessageOfTheExchangeIsSentAgainEachRetry) {
  Rig rig;
  int openings = 0;
  for (Instant now = rig.now; now < rig.now + seconds(20); now += milliseconds(1)) {
    if (rig.car->poll(now)) ++openings;
  }
  EXPECT_EQ(openings, 200);
  const auto opening = rig.car->poll(rig.now + seconds(20));
  ASSERT_TRUE(opening);
  rig.base->feed(opening->first, kCarAddress, rig.now);
  const auto lost = rig.base->poll(rig.now);
  ASSERT_TRUE(lost);
  rig.base->feed(opening->first, kCarAddress, rig.now);
  EXPECT_FALSE(rig.base->poll(rig.now)) << "a copy has no answer";
  const auto next = rig.car->poll(rig.now + seconds(20) + kRetry);
  ASSERT_TRUE(next);
  rig.base->feed(next->first, kCarAddress, rig.now);
  const auto again = rig.base->poll(rig.now);
  ASSERT_TRUE(again);
  EXPECT_TRUE(same(noise_part(lost->first), noise_part(again->first))) << "one attempt, one answer";
  rig.car->feed(again->first, kBaseAddress, rig.now);
  EXPECT_TRUE((*rig.car)->ready());
}

// The exchange over a link that loses half of everything, with a delay that is longer than kRetry.
TEST(Association, AnExchangeComesThroughLossAndADelayOfSeconds) {
  for (const std::int64_t delay_ms : {5, 150, 2'500}) {
    Rig rig;
    std::mt19937 random(5);
    struct Travelling {
      Instant at;
      Datagram datagram;
      bool to_base;
    };
    std::vector<Travelling> air;
    Instant now = rig.now;
    while (!(*rig.base)->ready() && now < rig.now + seconds(60)) {
      const auto send = [&](const Datagram& datagram, bool to_base) {
        if (random() % 2 == 0) air.push_back({now + milliseconds(delay_ms), datagram, to_base});
      };
      if (const auto due = rig.car->poll(now)) send(due->first, true);
      if (const auto due = rig.base->poll(now)) send(due->first, false);
      if (now.ns % milliseconds(20).ns == 0) {
        if (const Datagram d = rig.car->seal(1, now); !d.empty()) send(d, true);
      }
      const auto arrived = air;
      air.clear();
      for (const Travelling& t : arrived) {
        if (t.at > now)
          air.push_back(t);
        else if (t.to_base)
          rig.base->feed(t.datagram, kCarAddress, now);
        else
          rig.car->feed(t.datagram, kBaseAddress, now);
      }
      now += milliseconds(1);
    }
    EXPECT_TRUE((*rig.base)->ready()) << delay_ms << " ms";
    EXPECT_LT((now - rig.now).seconds(), 2.0 + 6.0 * static_cast<double>(delay_ms) / 1e3);
  }
}

// zenoh#496: no need to wait until the old peer's lease ends.
TEST(Association, ACarThatRestartedIsBackAfterOneExchange) {
  Rig rig;
  rig.establish();
  End restarted(rig.keys.car, 99);
  const Datagram old = rig.car->seal(5, rig.now);
  exchange(restarted, *rig.base, rig.now);
  EXPECT_TRUE(rig.base->feed(old, kCarAddress, rig.now)) << "until the new one speaks";
  EXPECT_FALSE(rig.base->feed(restarted.seal(6, rig.now), kCarAddress, rig.now))
      << "while the other one is heard it may be a second car";
  EXPECT_GE((*rig.base)->counters().second_peers, 1U);
  rig.now += kTakeOver;
  const auto opened = rig.base->feed(restarted.seal(6, rig.now), kCarAddress, rig.now);
  ASSERT_TRUE(opened && opened->new_session);
  EXPECT_EQ((*rig.base)->session(), 2U);
  EXPECT_EQ((*rig.base)->peer()->boot, 99U);
  EXPECT_FALSE(rig.base->feed(rig.car->seal(7, rig.now), kCarAddress, rig.now));
  EXPECT_TRUE(restarted.feed(rig.base->seal(8, rig.now), kBaseAddress, rig.now));
}

TEST(Association, ABaseThatRestartedIsBackAfterOneExchangeAndNoWait) {
  Rig rig;
  rig.establish();
  End restarted(rig.keys.base, 98);
  const Instant now = rig.now + milliseconds(200);
  const Datagram refused = rig.car->seal(2, now);
  EXPECT_FALSE(restarted.feed(refused, kCarAddress, now));
  const auto hint = restarted.poll(now);
  ASSERT_TRUE(hint);
  EXPECT_LE(hint->first.size(), refused.size()) << "amplifies nothing";
  rig.car->feed(hint->first, kBaseAddress, now);
  establish(*rig.car, restarted, now);
  EXPECT_EQ((*rig.car)->session(), 2U);
  EXPECT_EQ((*rig.car)->peer()->boot, 98U);
}

TEST(Association, ABaseWhoseHintsAreLostIsFoundByItsSilence) {
  Rig rig;
  rig.establish();
  EXPECT_FALSE(rig.car->poll(rig.now + kSilenceOpens - nanoseconds(1)));
  EXPECT_TRUE(rig.car->poll(rig.now + kSilenceOpens));
  EXPECT_TRUE((*rig.car)->ready()) << "the session that may still work is kept meanwhile";
  const Instant later = rig.now + kSilenceOpens + milliseconds(1);
  EXPECT_TRUE(rig.car->feed(rig.base->seal(3, later), kBaseAddress, later));
  EXPECT_FALSE(rig.car->poll(later + kRetry));
}

TEST(Association, AHintMovesNothingWhileTheSessionWorks) {
  Rig rig;
  rig.establish();
  const Instant later = rig.now + milliseconds(200);
  End stranger(rig.keys.base, 98);
  stranger.feed(rig.car->seal(2, rig.now), kCarAddress, rig.now);
  const auto hint = stranger.poll(rig.now);
  ASSERT_TRUE(hint);
  ASSERT_TRUE(rig.car->feed(rig.base->seal(2, later), kBaseAddress, later));
  rig.car->feed(hint->first, kBaseAddress, later);
  EXPECT_FALSE(rig.car->poll(later)) << "the base has just spoken";
  EXPECT_EQ(rig.car->refused(Refusal::kForeignBoot), 1U);
  for (std::size_t bit = 0; bit < 8 * hint->first.size(); ++bit) {
    Datagram forged = hint->first;
    forged[bit / 8] = static_cast<std::uint8_t>(forged[bit / 8] ^ 1U << bit % 8);
    rig.car->feed(forged, kBaseAddress, later + milliseconds(500));
    ASSERT_FALSE(rig.car->poll(later + milliseconds(500))) << "bit " << bit;
  }
}

TEST(Association, TwoPathsShareOneWindowAndOneSession) {
  Rig rig({.paths = 2});
  rig.establish();
  const Datagram datagram = rig.car->seal(9, rig.now);
  EXPECT_TRUE(rig.base->feed(datagram, kElsewhere, rig.now, 1));
  EXPECT_FALSE((*rig.base)->last_duplicate());
  EXPECT_FALSE(rig.base->feed(datagram, kCarAddress, rig.now, 0));
  EXPECT_EQ((*rig.base)->last_duplicate(), 2U);
  EXPECT_EQ((*rig.base)->counters().duplicates, 1U);
  Datagram forged = datagram;
  forged.back() = static_cast<std::uint8_t>(forged.back() ^ 1U);
  EXPECT_FALSE(rig.base->feed(forged, kCarAddress, rig.now, 0));
  EXPECT_FALSE((*rig.base)->last_duplicate()) << "a forged one says nothing about a path";
}

// The copy by the slower path is a duplicate each time, and still says where the car is on it.
TEST(Association, TheSlowerPathLearnsItsAddressFromCopies) {
  Rig rig({.paths = 2});
  rig.establish();
  const Datagram datagram = rig.car->seal(9, rig.now);
  ASSERT_TRUE(rig.base->feed(datagram, kCarAddress, rig.now, 0));
  ASSERT_FALSE(rig.base->feed(datagram, kElsewhere, rig.now, 1));
  ASSERT_EQ((*rig.base)->addresses(1).targets(50).size(), 1U);
  EXPECT_EQ((*rig.base)->addresses(1).targets(50)[0], kElsewhere);
  const auto token = (*rig.base)->addresses(1).token();
  ASSERT_TRUE(token);
  (*rig.base)->take_proof(1, kElsewhere, *token, rig.now);
  EXPECT_EQ((*rig.base)->addresses(1).proved(), kElsewhere);
  // The same again from a third place, on either path, moves nothing.
  const UdpAddress third{.ip = 3, .port = 3};
  for (const PathId path : {PathId{0}, PathId{1}}) {
    EXPECT_FALSE(rig.base->feed(datagram, third, rig.now, path));
    EXPECT_FALSE((*rig.base)->addresses(path).token());
  }
}

TEST(Association, SignedModeIsAgreedOnOrThereIsNoSession) {
  Rig rig({.signed_only = true});
  rig.establish();
  const Datagram datagram = rig.car->seal(0x01020304, rig.now);
  EXPECT_EQ(parse_header(datagram)->kind, Kind::kSigned);
  EXPECT_TRUE(rig.base->feed(datagram, kCarAddress, rig.now));
  End sealed_base(rig.keys.base, 5);
  End car(rig.keys.car, 6, {.signed_only = true});
  sealed_base.feed(car.poll(rig.now)->first, kCarAddress, rig.now);
  EXPECT_EQ(sealed_base.refused(Refusal::kWrongMode), 1U);
  const auto answer = sealed_base.poll(rig.now);
  ASSERT_TRUE(answer) << "the car is told why";
  car.feed(answer->first, kBaseAddress, rig.now);
  EXPECT_EQ(car.refused(Refusal::kWrongMode), 1U);
  EXPECT_FALSE(car->ready());
  EXPECT_FALSE(sealed_base.feed(car.seal(1, rig.now), kCarAddress, rig.now));
}

// mavlink CVE-2020-10283: an attacker makes the ends fall back to unsigned packets.
TEST(Association, APacketOfTheOtherModeIsRefusedWhateverItsTag) {
  Rig rig;
  rig.establish();
  Datagram datagram = rig.car->seal(1, rig.now);
  Header header = *parse_header(datagram);
  header.kind = Kind::kSigned;
  write_header(header, datagram);
  EXPECT_FALSE(rig.base->feed(datagram, kCarAddress, rig.now));
  EXPECT_EQ(rig.base->refused(Refusal::kWrongMode), 1U);
}

TEST(Association, ANewAddressGetsThreeTimesWhatItSentUntilItProvesItself) {
  Rig rig;
  rig.establish();
  Association& base = **rig.base;
  const Datagram moved = rig.car->seal(2, rig.now);
  ASSERT_TRUE(rig.base->feed(moved, kElsewhere, rig.now));
  std::size_t to_new = 0;
  for (int i = 0; i < 100; ++i) {
    for (const UdpAddress to : base.addresses(0).targets(50)) {
      base.note_sent(0, to, 50);
      if (to == kElsewhere) to_new += 50;
    }
    ASSERT_EQ(base.addresses(0).targets(50)[0], kCarAddress) << "the old one is served beside it";
  }
  EXPECT_GT(to_new, 2 * moved.size());
  EXPECT_LE(to_new, 3 * moved.size());
  const auto token = base.addresses(0).token();
  ASSERT_TRUE(token);
  base.take_proof(0, kElsewhere, *token + 1, rig.now);
  base.take_proof(0, kCarAddress, *token, rig.now);
  EXPECT_EQ(base.addresses(0).proved(), kCarAddress);
  base.take_proof(0, kElsewhere, *token, rig.now);
  EXPECT_EQ(base.addresses(0).proved(), kElsewhere);
  EXPECT_EQ(base.addresses(0).targets(1'000).size(), 1U);
  EXPECT_EQ(base.counters().roams, 1U);
}

TEST(Association, NothingIsAllocatedAfterConstruction) {
  if (!pitwall::testing::kAllocationsCounted) GTEST_SKIP() << "the sanitizer has a heap of its own";
  const KeyPair keys = make_pair(1);
  SeededRandomness car_random(1), base_random(2);
  Association car({.keys = keys.car, .peer = {kBaseAddress, {}}}, car_random);
  Association base({.keys = keys.base}, base_random);
  std::array<std::uint8_t, kMaxDatagram> out{}, reply{}, plain{};
  const std::array<std::uint8_t, 100> body{};
  Instant now{1};
  bool passed = false;
  EXPECT_EQ(pitwall::testing::allocations_of([&] {
              const auto opening = car.poll(0, now, out);
              base.feed(opening->bytes, 0, kCarAddress, now, plain);
              const auto answer = base.poll(0, now, reply);
              car.feed(answer->bytes, 0, kBaseAddress, now, plain);
              for (int i = 0; i < 1'000; ++i) {
                now += kPhaseTime / 100;
                const auto up = car.seal(body, now, out);
                passed = base.feed(up->datagram, 0, kCarAddress, now, plain).has_value();
                base.feed(up->datagram.first(50), 0, kElsewhere, now, plain);
                const auto down = base.seal(body, now, out);
                passed = passed && car.feed(down->datagram, 0, kBaseAddress, now, plain);
              }
            }),
            0U);
  EXPECT_TRUE(passed);
  EXPECT_GE(car.counters().phases, 18U);
}

}  // namespace
}  // namespace pitwall::telemetry::testing
