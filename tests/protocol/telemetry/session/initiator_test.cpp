// Where a car looks for its base, and what it believes of an answer.
// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/initiator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "tests/protocol/telemetry/session/rig.hpp"

namespace pitwall::telemetry::testing {
namespace {

constexpr UdpAddress kMoved{.ip = 0x0A000042, .port = 6'001},
    kSpare{.ip = 0x0A000003, .port = 6'001}, kOther{.ip = 0x0A000004, .port = 6'002};

EndOptions with_spares(std::initializer_list<UdpAddress> spares) {
  EndOptions options;
  for (const UdpAddress spare : spares) EXPECT_TRUE(options.spare[0].push(spare));
  return options;
}

// The base is heard from kMoved and proves that it is there.
void move_base(Rig& rig) {
  ASSERT_TRUE(rig.car->feed(rig.base->seal(1, rig.now), kMoved, rig.now));
  const auto token = (*rig.car)->addresses(0).token();
  ASSERT_TRUE(token);
  (*rig.car)->take_proof(0, kMoved, *token, rig.now);
  ASSERT_EQ((*rig.car)->addresses(0).proved(), kMoved);
}

// To where openings leave in this time, and the longest gap of each.
std::map<std::uint32_t, Duration> openings(End& car, Instant& now, Duration length) {
  std::map<std::uint32_t, Instant> last;
  std::map<std::uint32_t, Duration> gap;
  for (const Instant end = now + length; now < end; now += milliseconds(1)) {
    const auto opening = car.poll(now);
    if (!opening) continue;
    const std::uint32_t to = opening->second.ip;
    if (last.contains(to)) gap[to] = std::max(gap[to], now - last[to]);
    if (!last.contains(to)) gap[to] = {};
    last[to] = now;
  }
  return gap;
}

TEST(Initiator, AfterASecondOfSilenceEachKnownAddressIsOpenedTo) {
  Rig rig;
  rig.car = std::make_unique<End>(rig.keys.car, 11, with_spares({kSpare, kOther}));
  rig.establish();
  move_base(rig);
  EXPECT_TRUE(openings(*rig.car, rig.now, kSilenceOpens).empty());
  const auto tried = openings(*rig.car, rig.now, seconds(5));
  for (const UdpAddress to : {kMoved, kBaseAddress, kSpare, kOther}) {
    ASSERT_TRUE(tried.contains(to.ip)) << to.ip;
    EXPECT_LE(tried.at(to.ip), milliseconds(500));
  }
  EXPECT_EQ(tried.size(), 4U);
}

TEST(Initiator, FromPowerOnTheFirstAddressHasASecondForItself) {
  Rig rig;
  End car(rig.keys.car, 12, with_spares({kSpare}));
  const auto first = openings(car, rig.now, kSilenceOpens);
  EXPECT_EQ(first.size(), 1U);
  EXPECT_TRUE(first.contains(kBaseAddress.ip));
  EXPECT_EQ(openings(car, rig.now, seconds(2)).size(), 2U);
}

// The base moved, proved it, and died; another one with its keys is where the car was told.
TEST(Initiator, ABaseAtTheConfiguredAddressIsFoundAfterTheOneThatMovedDied) {
  Rig rig;
  rig.establish();
  move_base(rig);
  End spare(rig.keys.base, 20);
  const Instant died = rig.now;
  while (!spare->ready() && rig.now - died < seconds(10)) {
    if (const auto opening = rig.car->poll(rig.now); opening && opening->second == kBaseAddress) {
      spare.feed(opening->first, kCarAddress, rig.now);
    }
    if (const auto answer = spare.poll(rig.now)) {
      rig.car->feed(answer->first, kBaseAddress, rig.now);
      spare.feed(rig.car->seal(1, rig.now), kCarAddress, rig.now);
    }
    rig.now += milliseconds(1);
  }
  EXPECT_LE(rig.now - died, kSilenceOpens + milliseconds(500));
  EXPECT_EQ((*rig.car)->addresses(0).proved(), kBaseAddress);
}

// Who answers faster from another address with what the base said does not become the base.
TEST(Initiator, AnAnswerProvesWhereTheOpeningWasSentNotWhereItCameFrom) {
  Rig rig;
  const auto opening = rig.car->poll(rig.now);
  rig.base->feed(opening->first, kCarAddress, rig.now);
  rig.car->feed(rig.base->poll(rig.now)->first, kElsewhere, rig.now);
  EXPECT_TRUE((*rig.car)->ready());
  EXPECT_EQ((*rig.car)->addresses(0).proved(), kBaseAddress);
}

TEST(Initiator, ASecondBaseThatAnswersIsCounted) {
  Rig rig;
  End second(rig.keys.base, 77);
  const auto opening = rig.car->poll(rig.now);
  rig.base->feed(opening->first, kCarAddress, rig.now);
  second.feed(opening->first, kCarAddress, rig.now);
  const auto answer = rig.base->poll(rig.now);
  rig.car->feed(answer->first, kBaseAddress, rig.now);
  rig.car->feed(answer->first, kBaseAddress, rig.now);
  EXPECT_EQ((*rig.car)->counters().second_peers, 0U) << "a copy of the first";
  rig.car->feed(second.poll(rig.now)->first, kSpare, rig.now);
  EXPECT_EQ((*rig.car)->counters().second_peers, 1U);
}

TEST(Initiator, ASecondCarThatKnocksIsCountedWhileTheFirstIsHeard) {
  Rig rig;
  rig.establish();
  End second(rig.keys.car, 78);
  rig.base->feed(second.poll(rig.now)->first, kElsewhere, rig.now);
  EXPECT_EQ((*rig.base)->counters().second_peers, 1U);
  rig.now += seconds(3);
  End restarted(rig.keys.car, 79);
  rig.base->feed(restarted.poll(rig.now)->first, kElsewhere, rig.now);
  EXPECT_EQ((*rig.base)->counters().second_peers, 1U) << "the first was silent: a restart";
}

// A path that died beside one that lives: the base is looked for there, and the session goes on.
TEST(Initiator, ASilentPathBesideALivingOneFindsTheBaseAgain) {
  EndOptions options{.paths = 2};
  Rig rig(options);
  rig.establish();
  Duration found{};
  const Instant begin = rig.now;
  move_base(rig);  // path 0, where nobody is any more
  for (; rig.now - begin < seconds(5); rig.now += milliseconds(1)) {
    for (const PathId path : {PathId{0}, PathId{1}}) {
      if (const auto due = rig.car->poll(rig.now, path); due && due->second == kBaseAddress) {
        rig.base->feed(due->first, kCarAddress, rig.now, path);
      }
      if (const auto due = rig.base->poll(rig.now, path)) {
        rig.car->feed(due->first, kBaseAddress, rig.now, path);
      }
    }
    if (rig.now.ns % milliseconds(20).ns != 0) continue;
    ASSERT_TRUE(rig.base->feed(rig.car->seal(1, rig.now), kCarAddress, rig.now, 1));
    ASSERT_TRUE(rig.car->feed(rig.base->seal(1, rig.now), kBaseAddress, rig.now, 1));
    if (found == Duration{} && (*rig.car)->addresses(0).proved() == kBaseAddress)
      found = rig.now - begin;
  }
  EXPECT_GE(found, kSilenceOpens);
  EXPECT_LE(found, kSilenceOpens + milliseconds(520));
  EXPECT_EQ((*rig.car)->session(), 1U);
  EXPECT_EQ((*rig.base)->session(), 1U);
}

}  // namespace
}  // namespace pitwall::telemetry::testing
