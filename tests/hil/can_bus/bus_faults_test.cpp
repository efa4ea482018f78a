// A bus on which things go wrong: load, error frames, retransmission, bus-off and back, to the bit.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "hil/can_bus/frame_length.hpp"
#include "hil/can_bus/memory_bus.hpp"
#include "tests/hil/can_bus/half_megabit.hpp"

namespace pitwall::can_bus {
namespace {

constexpr Instant kStart = Instant{} + seconds(1);

std::size_t received_by(std::uint8_t port, MemoryBus& bus, Instant now) {
  const auto all = bus.advance(now);
  return static_cast<std::size_t>(
      std::ranges::count_if(all, [port](const Delivery& d) { return d.to == port; }));
}

// Sends on and on, until the node is as wanted.
Instant until(MemoryBus& bus, std::uint8_t port, ErrorState wanted) {
  Instant now = kStart;
  for (int i = 0; i < 1'000'000 && bus.status(port).state != wanted; ++i) {
    if (bus.pending(port) == 0) bus.offer(port, frame_of(0x100), now);
    now += kBit;
    bus.advance(now);
  }
  EXPECT_EQ(bus.status(port).state, wanted);
  return now;
}

TEST(BusFaults, ATransmitterThatFailsIsBusOffAfterThirtyTwoTriesAndNobodyHearsIt) {
  MemoryBus bus{{.ports = 3}};
  bus.damage_transmitter(0, 1.0);
  ASSERT_TRUE(bus.offer(0, frame_of(0x100), kStart));
  EXPECT_EQ(received_by(1, bus, kStart + milliseconds(20)), 0u);
  EXPECT_EQ(bus.counters().error_frames, 32u);
  EXPECT_EQ(bus.status(0).send_errors, 256);
  EXPECT_EQ(bus.status(0).state, ErrorState::kBusOff);
  EXPECT_EQ(bus.status(1).receive_errors, 32) << "one for each error frame";
  EXPECT_EQ(bus.pending(0), 0u);
  EXPECT_FALSE(bus.offer(0, frame_of(0x101), kStart + milliseconds(20)));
  EXPECT_EQ(bus.status(0).dropped, 2u);
  // 32 tries of at most a frame and an error frame, and 8 bits more of the passive half.
  const std::uint32_t most =
      32 * (frame_length(frame_of(0x100)).bits + kErrorFrameBits) + 16 * kSuspendBits;
  EXPECT_LE(bus.counters().bits, most);
  EXPECT_GE(bus.counters().bits, 32 * (1 + kErrorFrameBits + kInterframeBits));
}

TEST(BusFaults, OnASilentBusItIsBackAfter1408Bits) {
  MemoryBus bus{{.ports = 2}};
  bus.damage_transmitter(0, 1.0);
  const Instant off = until(bus, 0, ErrorState::kBusOff) + milliseconds(100);
  bus.damage_transmitter(0, 0.0);
  bus.advance(off);
  EXPECT_EQ(bus.status(0).state, ErrorState::kBusOff) << "by itself never";
  ASSERT_TRUE(bus.restart(0, off));
  EXPECT_FALSE(bus.restart(0, off));
  bus.advance(off + kBit * 1407);
  EXPECT_EQ(bus.status(0).state, ErrorState::kBusOff);
  bus.advance(off + kBit * 1408);
  EXPECT_EQ(bus.status(0).state, ErrorState::kActive);
  EXPECT_EQ(bus.status(0).restarts, 1u);
  ASSERT_TRUE(bus.offer(0, frame_of(0x100), off + milliseconds(5)));
  EXPECT_EQ(received_by(1, bus, off + milliseconds(6)), 1u);
}

TEST(BusFaults, OnAFullBusItIsBackAfter128Frames) {
  MemoryBus bus{{.ports = 3}};
  bus.damage_transmitter(0, 1.0);
  const Instant off = until(bus, 0, ErrorState::kBusOff);
  const can::Frame babble = frame_of(0);
  bus.babble(2, babble, 1.0, off);
  ASSERT_TRUE(bus.restart(0, off));
  const Duration each = kBit * frame_length(babble).bits;
  bus.advance(off + each * 127);
  EXPECT_EQ(bus.status(0).state, ErrorState::kBusOff);
  bus.advance(off + each * 129);
  EXPECT_EQ(bus.status(0).state, ErrorState::kActive);
}

TEST(BusFaults, ABabblerAtFullLoadSilencesEverybodyElse) {
  MemoryBus bus{{.ports = 3}};
  bus.babble(2, frame_of(0), 1.0, kStart);
  Instant now = kStart + kBit;
  bus.advance(now);
  for (; now < kStart + seconds(2); now += milliseconds(10)) {
    bus.offer(0, frame_of(0x100), now);
    for (const Delivery& d : bus.advance(now)) EXPECT_EQ(d.from, 2);
  }
  EXPECT_EQ(bus.sent_by(0), 0u);
  EXPECT_EQ(bus.load(), 1.0);
  EXPECT_GE(bus.status(0).blocked, milliseconds(1900));
  bus.babble(2, frame_of(0), 0.0, now);
  bus.advance(now + milliseconds(2));
  EXPECT_EQ(bus.sent_by(0), 1u) << "the newest of its slot";
  EXPECT_EQ(bus.status(0).blocked, Duration{});
}

TEST(BusFaults, ABabblerFillsTheShareThatItIsGiven) {
  for (const double share : {0.1, 0.25, 0.5, 0.9}) {
    MemoryBus bus{{.ports = 2}};
    bus.babble(1, frame_of(0), share, Instant{});
    bus.advance(Instant{} + seconds(2));
    EXPECT_NEAR(bus.load(), share, 1e-3);
  }
}

TEST(BusFaults, TheLoadIsThatOfTheBits) {
  MemoryBus bus{{.ports = 2}};
  for (int i = 0; i < 2000; ++i) {
    bus.offer(0, frame_of(0x200), Instant{} + milliseconds(1) * i);
    bus.advance(Instant{} + milliseconds(1) * (i + 1));
  }
  EXPECT_NEAR(bus.load(), frame_length(frame_of(0x200)).bits / 500.0, 1e-12);
}

TEST(BusFaults, WhatIsDestroyedIsSentAgainAndArrivesOnce) {
  MemoryBus bus{{.ports = 2, .seed = 7}};
  bus.disturb(0.001);
  std::uint64_t incoming = 0;
  for (int i = 0; i < 5000; ++i) {
    const Instant at = kStart + milliseconds(1) * i;
    ASSERT_TRUE(bus.offer(0, frame_of(0x100), at));
    incoming += received_by(1, bus, at + milliseconds(1));
  }
  incoming += received_by(1, bus, kStart + seconds(6));
  EXPECT_EQ(incoming, 5000u);
  EXPECT_EQ(bus.status(0).dropped, 0u);
  // A share of 1 - (1 - p)^bits of all tries fails.
  const double bits = frame_length(frame_of(0x100)).bits - kInterframeBits;
  const double share = 1.0 - std::pow(0.999, bits);
  const auto errors = static_cast<double>(bus.counters().error_frames);
  EXPECT_NEAR(errors / (errors + 5000.0), share, 0.015);
}

TEST(BusFaults, AStalledControllerTakesFramesAndSendsNone) {
  MemoryBus bus{{.ports = 2}};
  bus.stall(0, true);
  ASSERT_TRUE(bus.offer(0, frame_of(0x100), kStart));
  EXPECT_EQ(received_by(1, bus, kStart + milliseconds(50)), 0u);
  EXPECT_EQ(bus.status(0).blocked, milliseconds(50));
  bus.stall(0, false);
  EXPECT_EQ(received_by(1, bus, kStart + milliseconds(51)), 1u);
  EXPECT_EQ(bus.status(0).blocked, Duration{});
}

TEST(BusFaults, APassiveNodeLeavesEightBitsAfterEachFrame) {
  MemoryBus bus{{.ports = 3}};
  bus.damage_transmitter(0, 1.0);
  Instant now = kStart;
  while (bus.status(0).send_errors < kPassiveLimit + 5 * kSendErrorStep) {
    if (bus.pending(0) == 0) bus.offer(0, frame_of(0x100), now);
    bus.advance(now += kBit);
  }
  bus.damage_transmitter(0, 0.0);
  bus.advance(now += milliseconds(2));
  const std::uint64_t before = bus.counters().bits;
  ASSERT_EQ(bus.status(0).state, ErrorState::kPassive);
  ASSERT_TRUE(bus.offer(0, frame_of(0x100), now));
  ASSERT_TRUE(bus.offer(0, frame_of(0x101), now));
  std::vector<Instant> ends;
  for (const Delivery& d : bus.advance(now + milliseconds(2)))
    if (d.to == 1) ends.push_back(d.received.at);
  ASSERT_EQ(ends.size(), 2u);
  const std::uint32_t second = frame_length(frame_of(0x101)).bits;
  EXPECT_EQ(ends[1] - ends[0], kBit * (kSuspendBits + second));
  EXPECT_GT(bus.counters().bits, before);
}

TEST(BusFaults, OneSeedOneRun) {
  const auto run = [](std::uint64_t seed) {
    MemoryBus bus{{.ports = 3, .seed = seed}};
    bus.disturb(0.002);
    std::vector<std::int64_t> ends;
    for (int i = 0; i < 500; ++i) {
      bus.offer(static_cast<std::uint8_t>(i % 3),
                frame_of(static_cast<std::uint32_t>(0x100 + i % 7)), kStart + milliseconds(1) * i);
      for (const Delivery& d : bus.advance(kStart + milliseconds(1) * (i + 1)))
        ends.push_back(d.received.at.ns);
    }
    return ends;
  };
  EXPECT_EQ(run(1), run(1));
  EXPECT_NE(run(1), run(2));
}

}  // namespace
}  // namespace pitwall::can_bus
