// SPDX-License-Identifier: Apache-2.0
// What went wrong in the field with other links' signing, each as a test by its name.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/protocol/telemetry/session/rig.hpp"

namespace pitwall::telemetry::testing {
namespace {

// MAVLink 2 drops each packet whose time stamp is not above the last one's.
TEST(FieldRecord, ReorderedPacketsAreAllAccepted) {
  Rig rig;
  rig.establish();
  std::vector<Datagram> sent;
  for (std::uint32_t i = 0; i < 1'000; ++i) sent.push_back(rig.car->seal(i, rig.now));
  std::reverse(sent.begin(), sent.end());
  for (const Datagram& datagram : sent) {
    EXPECT_TRUE(rig.base->feed(datagram, kCarAddress, rig.now));
    EXPECT_FALSE(rig.base->feed(datagram, kCarAddress, rig.now));
  }
}

// pymavlink 961: the stored time stamp never advanced, so that only the first packet was compared.
TEST(FieldRecord, TheWindowFollowsEveryPacket) {
  Rig rig;
  rig.establish();
  std::vector<Datagram> sent;
  for (std::uint32_t i = 0; i < 5'000; ++i) {
    sent.push_back(rig.car->seal(i, rig.now));
    ASSERT_TRUE(rig.base->feed(sent.back(), kCarAddress, rig.now));
  }
  for (const Datagram& datagram : sent) {
    ASSERT_FALSE(rig.base->feed(datagram, kCarAddress, rig.now));
  }
}

// ArduPilot 13860, QGroundControl 14375, node-mavlink 39: signing clocks that GPS moves, that began
// minutes apart, or count from another year.
TEST(FieldRecord, TheClocksOfTheTwoEndsNeedHaveNothingInCommon) {
  for (const std::int64_t ahead_s :
       {-3'000'000'000LL, -180LL, 0LL, 180LL, 3'600LL, 3'000'000'000LL}) {
    Rig rig;
    const Instant car_now = rig.now + seconds(ahead_s);
    const auto opening = rig.car->poll(car_now);
    ASSERT_TRUE(opening);
    rig.base->feed(opening->first, kCarAddress, rig.now);
    rig.car->feed(rig.base->poll(rig.now)->first, kBaseAddress, car_now);
    EXPECT_TRUE(rig.base->feed(rig.car->seal(1, car_now), kCarAddress, rig.now)) << ahead_s;
    EXPECT_TRUE(rig.car->feed(rig.base->seal(1, rig.now), kBaseAddress, car_now)) << ahead_s;
  }
}

// mavlink 983: an assumption that no packet travels for a minute.
TEST(FieldRecord, APacketThatTravelledForTwoMinutesIsStillAuthentic) {
  Rig rig;
  rig.establish();
  const Datagram slow = rig.car->seal(1, rig.now);
  EXPECT_TRUE(rig.base->feed(slow, kCarAddress, rig.now + seconds(120)))
      << "how old is too old is for those to say who know what is in it";
}

// PX4 28697: the links of one peer race on one table of time stamps.
TEST(FieldRecord, TwoLinksThatRaceLoseNothing) {
  Rig rig({.paths = 2});
  rig.establish();
  constexpr std::size_t kBehind = 300;  // packets by which the slow link is late
  std::vector<Datagram> slow;
  for (std::uint32_t i = 0; i < 3'000; ++i) {
    const Datagram datagram = rig.car->seal(i, rig.now);
    const bool arrives = i % 3 != 0;
    if (arrives) {
      EXPECT_TRUE(rig.base->feed(datagram, kCarAddress, rig.now, 0));
    }
    slow.push_back(datagram);
    if (slow.size() <= kBehind) continue;
    const std::size_t k = slow.size() - 1 - kBehind;
    EXPECT_EQ(rig.base->feed(slow[k], kElsewhere, rig.now, 1).has_value(), k % 3 == 0) << k;
  }
}

// MAVLink 2 takes a new stream that is up to a minute behind: a receiver that restarted hears the
// last minute again.
TEST(FieldRecord, ARestartedReceiverHearsNothingOfTheMinuteBefore) {
  Rig rig;
  rig.establish();
  std::vector<Datagram> minute;
  for (std::uint32_t i = 0; i < 3'000; ++i) minute.push_back(rig.car->seal(i, rig.now));
  End restarted(rig.keys.base, 50);
  for (const Datagram& datagram : minute) {
    ASSERT_FALSE(restarted.feed(datagram, kCarAddress, rig.now));
  }
  EXPECT_EQ(restarted.refused(Refusal::kNoSession), 3'000U);
}

// mavlink-router: the stream goes to the address of the last packet, whoever sent it.
TEST(FieldRecord, AForgedPacketStealsNoStream) {
  Rig rig;
  rig.establish();
  Datagram forged = rig.car->seal(1, rig.now);
  forged.back() = static_cast<std::uint8_t>(forged.back() ^ 1U);
  EXPECT_FALSE(rig.base->feed(forged, kElsewhere, rig.now));
  ASSERT_EQ((*rig.base)->addresses(0).targets(10).size(), 1U);
  EXPECT_EQ((*rig.base)->addresses(0).targets(10)[0], kCarAddress);
}

}  // namespace
}  // namespace pitwall::telemetry::testing
