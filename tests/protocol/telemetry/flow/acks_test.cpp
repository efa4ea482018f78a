// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/flow/acks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <type_traits>
#include <vector>

#include "tests/support/instants.hpp"

namespace pitwall::telemetry {
namespace {

static_assert(std::is_trivially_copyable_v<ReceivedPackets>);
static_assert(std::is_trivially_copyable_v<SentPackets>);

TEST(ReceivedPackets, NamesExactlyWhatCameOfTheLast33) {
  std::mt19937_64 random(1);
  ReceivedPackets book;
  EXPECT_FALSE(book.ack(at_ms(0)));
  std::set<std::uint64_t> came;
  const std::uint64_t start = (std::uint64_t{1} << 32) - 500;
  for (std::uint64_t i = 0; i < 3'000; ++i) {
    const std::uint64_t sequence = start + i + random() % 40;  // out of order, some twice
    book.received(sequence, at_ms(static_cast<std::int64_t>(i)));
    came.insert(sequence);
    if (i == 1'500) came.insert(start + i + 90), book.received(start + i + 90, at_ms(1'500));
    const auto ack = book.ack(at_ms(static_cast<std::int64_t>(i)));
    ASSERT_TRUE(ack);
    const std::uint64_t newest = *came.rbegin();
    ASSERT_EQ(ack->newest_low, static_cast<std::uint16_t>(newest));
    for (std::uint64_t k = 0; k < 32; ++k) {
      ASSERT_EQ((ack->mask >> k & 1U) != 0, came.contains(newest - 1 - k)) << i << ' ' << k;
    }
  }
}

TEST(ReceivedPackets, TheHoldCountsFromTheNewestAndANewSessionHasNoAck) {
  ReceivedPackets received;
  received.received(5, at_ms(1'000));
  EXPECT_EQ(received.ack(at_ms(1'007))->hold, milliseconds(7));
  received.received(4, at_ms(1'010));  // late: the newest one is still 5
  EXPECT_EQ(received.ack(at_ms(1'011))->hold, milliseconds(11));
  received.forget();
  EXPECT_FALSE(received.ack(at_ms(1'100)));
}

// A sender, a lossy way and a receiver; what the sender learns is compared with what came.
TEST(SentPackets, LearnsOnlyTheTruthAndEachPacketOnce) {
  for (const std::uint64_t start :
       {std::uint64_t{1}, (std::uint64_t{1} << 16) - 700, (std::uint64_t{1} << 32) - 1'000}) {
    std::mt19937_64 random(start);
    ReceivedPackets receipts;
    SentPackets sent;
    std::set<std::uint64_t> came, reported;
    for (std::uint64_t i = 0; i < 3'000; ++i) {
      const std::uint64_t sequence = start + i;
      sent.sent(sequence, at_ms(static_cast<std::int64_t>(20 * i)), 100 + i % 7);
      if (random() % 10 < 4) {
        receipts.received(sequence, at_ms(static_cast<std::int64_t>(20 * i + 5)));
        came.insert(sequence);
      }
      const auto ack = receipts.ack(at_ms(static_cast<std::int64_t>(20 * i + 9)));
      if (!ack || random() % 10 < 3) continue;
      const SentPackets::News news = sent.take(*ack);
      for (const Delivery& d : news.delivered) {
        ASSERT_TRUE(came.contains(d.sequence));
        ASSERT_TRUE(reported.insert(d.sequence).second) << "told twice";
        ASSERT_EQ(d.sent, at_ms(static_cast<std::int64_t>(20 * (d.sequence - start))));
        ASSERT_EQ(d.bytes, 100 + (d.sequence - start) % 7);
      }
      ASSERT_TRUE(news.newest);
      ASSERT_EQ(news.newest->sequence, *came.rbegin());
    }
    EXPECT_EQ(sent.nonsense(), 0U);
    EXPECT_GT(reported.size(), came.size() * 99 / 100);
  }
}

TEST(SentPackets, CountsNonsenseAndIgnoresIt) {
  SentPackets book;
  EXPECT_EQ(book.take({.newest_low = 3}).delivered.size(), 0U);
  EXPECT_EQ(book.nonsense(), 1U);
  for (std::uint64_t s = 1; s <= 10; ++s) book.sent(s, at_ms(0), 50);
  EXPECT_EQ(book.take({.newest_low = 11}).delivered.size(), 0U);  // never sent
  EXPECT_EQ(book.nonsense(), 2U);
  EXPECT_EQ(book.take({.newest_low = 5, .mask = 1U << 4}).delivered.size(), 0U);  // number zero
  EXPECT_EQ(book.nonsense(), 3U);
  EXPECT_EQ(book.take({.newest_low = 5, .mask = 0b11}).delivered.size(), 3U);
  EXPECT_EQ(book.take({.newest_low = 5, .mask = 0b11}).delivered.size(), 0U);
  EXPECT_EQ(book.nonsense(), 3U);
  book.forget();
  EXPECT_EQ(book.nonsense(), 3U);
  EXPECT_FALSE(book.take({.newest_low = 5}).newest);
}

TEST(SentPackets, RandomAcksNeverTellOfWhatWasNotSent) {
  std::mt19937_64 random(3);
  SentPackets book;
  std::set<std::uint64_t> reported;
  std::uint64_t sequence = (std::uint64_t{1} << 32) - 300;
  const std::uint64_t first = sequence;
  for (int i = 0; i < 50'000; ++i) {
    if (random() % 4 == 0) book.sent(sequence++, at_ms(i), 10);
    const Ack ack{static_cast<std::uint16_t>(random()), static_cast<std::uint32_t>(random()),
                  microseconds(100) * static_cast<std::int64_t>(random() % 0x10000)};
    for (const Delivery& d : book.take(ack).delivered) {
      ASSERT_TRUE(d.sequence >= first && d.sequence < sequence);
      ASSERT_TRUE(reported.insert(d.sequence).second);
    }
  }
  EXPECT_GT(book.nonsense(), 0U);
}

TEST(SentPackets, AnUnknownHoldIsNoTime) {
  SentPackets book;
  book.sent(1, at_ms(0), 50);
  const SentPackets::News news = book.take({.newest_low = 1, .hold = microseconds(100) * 0xFFFF});
  EXPECT_EQ(news.delivered.size(), 1U);
  EXPECT_FALSE(news.newest);
}

}  // namespace
}  // namespace pitwall::telemetry
