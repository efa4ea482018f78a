// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/memory_bus.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "hil/can_bus/frame_length.hpp"
#include "tests/hil/can_bus/half_megabit.hpp"
#include "tests/hil/can_bus/random_words.hpp"

namespace pitwall::can_bus {
namespace {

std::vector<Delivery> advance(MemoryBus& bus, Instant now) {
  const auto incoming = bus.advance(now);
  return {incoming.begin(), incoming.end()};
}

struct Received {
  std::uint8_t to, from;
  can::Frame frame;
  Instant at;
  bool operator==(const Received&) const = default;
};
void note(std::vector<Received>& log, std::span<const Delivery> incoming) {
  for (const Delivery& d : incoming) log.push_back({d.to, d.from, d.received.frame, d.received.at});
}

TEST(MemoryBus, DeliversToEveryOtherPortAtTheEndOfTheFrame) {
  MemoryBus bus{{.ports = 3}};
  const can::Frame f = frame_of(0x123);
  ASSERT_TRUE(bus.offer(1, f, Instant{} + milliseconds(1)));
  const Duration length = kBit * (frame_length(f).bits - kInterframeBits);
  const Instant end = Instant{} + milliseconds(1) + length;
  EXPECT_TRUE(advance(bus, end - nanoseconds(1)).empty());
  const auto incoming = advance(bus, end);
  ASSERT_EQ(incoming.size(), 2U);
  EXPECT_EQ(incoming[0].to, 0);
  EXPECT_EQ(incoming[1].to, 2);
  for (const Delivery& d : incoming) {
    EXPECT_EQ(d.from, 1);
    EXPECT_EQ(d.received.frame, f);
    EXPECT_EQ(d.received.at, end);
  }
  EXPECT_TRUE(advance(bus, end + seconds(1)).empty());
}

TEST(MemoryBus, TheLowestIdentifierWinsWhateverTheOrderOfOffers) {
  std::vector<std::uint32_t> ids{0x514, 0x050, 0x7FF, 0x515, 0x57A};
  std::sort(ids.begin(), ids.end());
  std::vector<Received> reference;
  do {
    MemoryBus bus{{.ports = 6}};
    for (std::size_t i = 0; i < ids.size(); ++i)  // the port goes with the identifier
      ASSERT_TRUE(
          bus.offer(static_cast<std::uint8_t>(1 + ids[i] % 5), frame_of(ids[i]), Instant{}));
    std::vector<Received> log;
    note(log, bus.advance(Instant{} + seconds(1)));
    if (reference.empty()) reference = log;
    ASSERT_EQ(log, reference);
    std::vector<std::uint32_t> order;
    for (const Received& h : log)
      if (h.to == 0) order.push_back(h.frame.id);
    ASSERT_TRUE(std::is_sorted(order.begin(), order.end()));
    ASSERT_EQ(order.size(), ids.size());
  } while (std::next_permutation(ids.begin(), ids.end()));
}

TEST(MemoryBus, AFrameOnTheWireIsNotInterrupted) {
  MemoryBus bus{{.ports = 2}};
  const can::Frame low = frame_of(0x700), high = frame_of(0x001);
  ASSERT_TRUE(bus.offer(0, low, Instant{}));
  ASSERT_TRUE(bus.offer(1, high, Instant{} + microseconds(10)));
  const auto incoming = advance(bus, Instant{} + seconds(1));
  ASSERT_EQ(incoming.size(), 2U);
  EXPECT_EQ(incoming[0].received.frame, low);
  EXPECT_EQ(
      incoming[1].received.at,
      Instant{} + kBit * (frame_length(low).bits + frame_length(high).bits - kInterframeBits));
}

TEST(MemoryBus, TheNewestValueOfAnIdentifierWins) {
  MemoryBus bus{{.ports = 2}};
  ASSERT_TRUE(bus.offer(0, frame_of(0x001, 8, 1), Instant{}));  // keeps the bus busy
  ASSERT_TRUE(bus.offer(0, frame_of(0x100, 8, 2), Instant{}));
  ASSERT_TRUE(bus.offer(0, frame_of(0x100, 8, 3), Instant{} + microseconds(50)));
  const auto incoming = advance(bus, Instant{} + seconds(1));
  ASSERT_EQ(incoming.size(), 2U);
  EXPECT_EQ(incoming[1].received.frame, frame_of(0x100, 8, 3));
  EXPECT_EQ(bus.counters().overwritten, 1U);
  EXPECT_EQ(bus.counters().sent, 2U);
}

struct Offer {
  Instant at;
  std::uint8_t port;
  can::Frame frame;
};

std::vector<Offer> random_traffic(std::uint32_t seed, int frames, int gap_us) {
  RandomWords rng{std::mt19937{seed}};
  std::vector<Offer> offers;
  Instant at{};
  for (int i = 0; i < frames; ++i) {
    at += microseconds(static_cast<std::int64_t>(rng() % static_cast<std::uint32_t>(gap_us)));
    offers.push_back({at, static_cast<std::uint8_t>(rng() % 4),
                      frame_of(rng() % 0x800, static_cast<std::uint8_t>(rng() % 9),
                               static_cast<std::uint8_t>(rng()))});
  }
  return offers;
}

// Offers at their instants; advance() at every multiple of `step` as well.
std::vector<Received> play(MemoryBus& bus, const std::vector<Offer>& offers, Duration step) {
  std::vector<Received> log;
  Instant tick{};
  for (const Offer& o : offers) {
    while (tick <= o.at) {
      note(log, bus.advance(tick));
      tick += step;
    }
    bus.offer(o.port, o.frame, o.at);
  }
  note(log, bus.advance(tick + seconds(1)));
  return log;
}

TEST(MemoryBus, WhatIsHeardDoesNotDependOnHowOftenItIsAskedFor) {
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const auto offers = random_traffic(seed, 2000, 400);
    MemoryBus fine{{.ports = 4}}, coarse{{.ports = 4}}, again{{.ports = 4}};
    const auto reference = play(fine, offers, microseconds(37));
    ASSERT_FALSE(reference.empty());
    EXPECT_EQ(play(coarse, offers, milliseconds(10)), reference) << "seed " << seed;
    EXPECT_EQ(play(again, offers, microseconds(37)), reference) << "seed " << seed;
  }
}

TEST(MemoryBus, EveryOfferIsAccountedForAndNothingOverlaps) {
  for (const int gap_us : {100, 300, 800}) {
    const auto offers = random_traffic(7, 3000, gap_us);
    MemoryBus bus{{.ports = 4}};
    const auto log = play(bus, offers, milliseconds(1));
    const BusCounters& c = bus.counters();
    EXPECT_EQ(c.sent + c.overwritten + c.lost, offers.size()) << gap_us;
    EXPECT_EQ(log.size(), 3 * c.sent);
    for (std::size_t i = 3; i < log.size(); i += 3) {
      const Duration whole = kBit * (frame_length(log[i].frame).bits);
      ASSERT_GE(log[i].at - log[i - 3].at, whole) << "frame " << i / 3;
    }
  }
}

TEST(MemoryBus, TheHighestPriorityWaitsAtMostForOneFrame) {
  RandomWords rng{std::mt19937{11}};
  MemoryBus bus{{.ports = 2}};
  const can::Frame urgent = frame_of(0x000, 4, 0xA5);
  const Duration bound = kBit * (55 + 80 + frame_length(urgent).bits);
  Instant now{};
  int received_count = 0;
  for (int round = 0; round < 200; ++round) {
    const Instant asked = now + microseconds(static_cast<std::int64_t>(rng() % 900));
    for (std::uint32_t i = 0; i < 4; ++i) bus.offer(0, frame_of(0x700 + i, 8, 0), now);
    bus.offer(1, urgent, asked);
    now += milliseconds(2);
    for (const Delivery& d : bus.advance(now)) {
      if (d.received.frame.id != 0) continue;
      ++received_count;
      EXPECT_LE(d.received.at - asked, bound);
    }
  }
  EXPECT_EQ(received_count, 200);
}

TEST(MemoryBus, LoadIsBitsPerSecondOverBitRate) {
  MemoryBus bus{{.ports = 2}};
  const can::Frame f = frame_of(0x514);
  Instant now{};
  for (int i = 0; i < 2000; ++i) {
    bus.offer(0, f, now);
    now += milliseconds(1);
    bus.advance(now);
  }
  const double expected = frame_length(f).bits * 1000.0 / 500'000.0;
  EXPECT_NEAR(bus.load(), expected, 1e-12);
  EXPECT_EQ(bus.counters().bits, 2000U * frame_length(f).bits);
  EXPECT_EQ(bus.sent_by(0), 2000U);
  EXPECT_EQ(bus.sent_by(1), 0U);
  bus.advance(now + seconds(5));
  EXPECT_EQ(bus.load(), 0.0);
}

TEST(MemoryBus, ABabblingNodeFillsTheBusAndStarvesTheRest) {
  MemoryBus bus{{.ports = 2}};
  Instant now{};
  for (int i = 0; i < 20'000; ++i) {
    bus.offer(0, frame_of(0x000), now);
    if (i % 100 == 0) bus.offer(1, frame_of(0x514), now);
    now += microseconds(100);
    bus.advance(now);
  }
  EXPECT_GT(bus.load(), 0.99);
  EXPECT_LE(bus.load(), 1.0);
  EXPECT_EQ(bus.sent_by(1), 0U);
}

TEST(MemoryBus, ADisconnectedPortNeitherSendsNorHears) {
  MemoryBus bus{{.ports = 3}};
  bus.offer(1, frame_of(0x010), Instant{});
  bus.connect(1, false);
  EXPECT_EQ(bus.pending(1), 0U);
  EXPECT_FALSE(bus.offer(1, frame_of(0x011), Instant{}));
  bus.offer(0, frame_of(0x012), Instant{});
  const auto incoming = advance(bus, Instant{} + seconds(1));
  ASSERT_EQ(incoming.size(), 1U);
  EXPECT_EQ(incoming[0].to, 2);
  EXPECT_EQ(bus.counters().lost, 2U);
  bus.connect(1, true);
  EXPECT_TRUE(bus.offer(1, frame_of(0x011), Instant{} + seconds(1)));
}

TEST(MemoryBus, RefusesWhatDoesNotFitAndCountsIt) {
  MemoryBus bus{{.ports = 2}};
  can::Frame fd = frame_of(1);
  fd.fd = true;
  EXPECT_FALSE(bus.offer(0, fd, Instant{}));
  EXPECT_EQ(bus.counters().refused, 1U);
  for (std::uint32_t i = 0; i < kMaxPending; ++i)
    EXPECT_TRUE(bus.offer(0, frame_of(0x100 + i), Instant{}));
  EXPECT_FALSE(bus.offer(0, frame_of(0x050), Instant{}));
  EXPECT_EQ(bus.counters().lost, 1U);
}

}  // namespace
}  // namespace pitwall::can_bus
