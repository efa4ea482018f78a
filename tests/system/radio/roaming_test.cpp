// The source of one end changes each second while 30 % of the datagrams are lost.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <optional>

#include "tests/system/radio/radio_setups.hpp"

namespace pitwall::radio {
namespace {

using telemetry::PathId;

UdpAddress address(std::uint32_t n) {
  return {0x0A010000U + n, static_cast<std::uint16_t>(10'000 + n * 7)};
}

// From the first packet that reached the base from the new place to the first that the car has from
// the base there.
TEST(Roaming, TheCarIsServedASlotAfterItsFirstSurvivingPacket) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    RadioSetup setup = lossy(0.3, seed);
    setup.up[0].loss = 0.0;  // what comes back is counted when it leaves
    VirtualRadio radio(setup);
    radio.run(seconds(2));
    Duration worst{};
    for (std::uint32_t n = 0; n < 60; ++n) {
      radio.move_car(0, address(n));
      const std::uint64_t roams = radio.base_report().association.roams;
      const Instant moved = radio.now();
      std::optional<Instant> received, served;
      for (int ms = 0; ms < 1'000; ++ms) {
        const std::uint64_t before = radio.arrivals();
        const std::uint64_t opened = radio.car_report().association.opened;
        radio.step();
        // Packets of before the move still come for a while; from then on, of the new place.
        const bool new_place = radio.now() - moved > milliseconds(40);
        if (!received && new_place && radio.arrivals() > before) received = radio.now();
        if (received && !served && radio.car_report().association.opened > opened) {
          served = radio.now();
        }
      }
      ASSERT_TRUE(received && served) << n;
      worst = std::max(worst, *served - *received);
      EXPECT_GT(radio.base_report().association.roams, roams) << n;
    }
    // A slot until the base speaks, and the way.
    EXPECT_LE(worst, telemetry::kSlot + kWay + milliseconds(10)) << seed;
    EXPECT_EQ(radio.content_errors().all(), 0u);
    EXPECT_EQ(radio.base_report().sessions, 1u);
  }
}

TEST(Roaming, TheBaseMovesToo) {
  VirtualRadio radio(lossy(0.3, 4));
  radio.run(seconds(2));
  for (std::uint32_t n = 0; n < 30; ++n) {
    radio.move_base(0, address(n));
    radio.run(seconds(1));
    EXPECT_EQ(radio.car_report().paths[0].peer, address(n)) << n;
  }
  EXPECT_EQ(radio.base_report().sessions, 1u);
  EXPECT_EQ(radio.content_errors().all(), 0u);
}

TEST(Roaming, OneOfTwoRadiosMovesAndTheOtherCarriesOn) {
  VirtualRadio radio(lossy(0.3, 5, 2));
  radio.run(seconds(2));
  radio.reset_ages();
  for (std::uint32_t n = 0; n < 30; ++n) {
    radio.move_car(static_cast<PathId>(n % 2), address(n));
    radio.run(seconds(1));
    EXPECT_EQ(radio.base_report().paths[n % 2].peer, address(n)) << n;
  }
  EXPECT_EQ(radio.content_errors().all(), 0u);
}

TEST(Roaming, AReplayedPacketFromElsewhereRedirectsNothing) {
  VirtualRadio radio(lossy(0.0, 6));
  std::vector<std::uint8_t> newest;
  radio.tap([&](bool down, PathId, std::span<const std::uint8_t> bytes) {
    if (down) newest.assign(bytes.begin(), bytes.end());
    return true;
  });
  radio.run(seconds(5));
  const UdpAddress before = radio.base_report().paths[0].peer;
  std::uint64_t to_thief = 0;
  for (int i = 0; i < 500; ++i) {
    radio.inject(true, 0, address(99), newest);
    radio.run(milliseconds(10));
    if (radio.base_report().paths[0].peer == address(99)) ++to_thief;
  }
  EXPECT_EQ(to_thief, 0u);
  EXPECT_EQ(radio.base_report().paths[0].peer, before);
  EXPECT_EQ(radio.content_errors().all(), 0u);
}

}  // namespace
}  // namespace pitwall::radio
