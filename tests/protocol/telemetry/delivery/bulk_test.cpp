// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/delivery/bulk.hpp"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <random>

#include "protocol/bits/crc.hpp"
#include "tests/protocol/telemetry/delivery/delivery_rig.hpp"
#include "tests/support/allocation_guard.hpp"

namespace pitwall::telemetry {
namespace {

constexpr Duration kRoundTrip = milliseconds(90);

struct BulkRig : DeliveryRig<BulkSender, BulkReceiver> {
  using DeliveryRig::DeliveryRig;
  void step() {
    slot([&](BodyWriter& body) { sender.fill(body, kRoundTrip, now); });
  }
};

Bytes random_bytes(std::mt19937& random, std::size_t size) {
  Bytes bytes(size);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

bool same(std::span<const std::uint8_t> a, const Bytes& b) { return std::ranges::equal(a, b); }

TEST(Bulk, ObjectsComeWholeAndOnceWhateverTheAirDoes) {
  for (const double loss : {0.0, 0.3, 0.7}) {
    for (const std::size_t size : {1UL, 59UL, 60UL, 61UL, 64UL, 5'000UL, 16'400UL, kBulkObject}) {
      BulkRig rig(rough(loss, static_cast<std::uint32_t>(size)));
      std::mt19937 random(1);
      const Bytes bytes = random_bytes(random, size);
      ASSERT_TRUE(rig.sender.offer(BulkKind::kPath, bytes));
      std::size_t seen = 0;
      for (int slot = 0; slot < 4'000 && !rig.sender.idle(); ++slot) {
        rig.step();
        while (const auto object = rig.receiver.next()) {
          ++seen;
          EXPECT_TRUE(object->kind == BulkKind::kPath && same(object->bytes, bytes));
        }
      }
      EXPECT_EQ(seen, 1U);
      EXPECT_TRUE(rig.sender.idle());
      EXPECT_EQ(rig.sender.counters().delivered, 1U);
      EXPECT_EQ(rig.receiver.counters().delivered, 1U);
    }
  }
}

TEST(Bulk, TheNewestOfAKindWinsAndAnOlderOneIsNeverHandedOutAfterIt) {
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    BulkRig rig(rough(0.4, seed));
    std::mt19937 random(seed);
    std::map<BulkKind, std::vector<Bytes>> offered;
    std::map<BulkKind, std::size_t> seen;  // how many of the kind are known to be over
    for (int slot = 0; slot < 4'000; ++slot) {
      if (slot < 2'000 && random() % 40 == 0) {
        const auto kind = static_cast<BulkKind>(random() % kBulkKinds);
        offered[kind].push_back(random_bytes(random, 1 + random() % 9'000));
        ASSERT_TRUE(rig.sender.offer(kind, offered[kind].back()));
      }
      rig.step();
      while (const auto object = rig.receiver.next()) {
        const auto& all = offered[object->kind];
        std::size_t& next = seen[object->kind];
        while (next < all.size() && !same(object->bytes, all[next])) ++next;
        ASSERT_LT(next, all.size()) << "not whole, again, or older than the last";
        ++next;
      }
    }
    for (const auto& [kind, all] : offered) EXPECT_EQ(seen[kind], all.size());
    EXPECT_TRUE(rig.sender.idle());
    EXPECT_GT(rig.sender.counters().superseded, 0U);
    EXPECT_GT(rig.receiver.counters().superseded, 0U);
    EXPECT_EQ(rig.receiver.counters().malformed + rig.sender.counters().malformed, 0U);
  }
}

TEST(Bulk, AtThirtyPercentLossNeedsLittleMoreThanTheLossAsksFor) {
  constexpr double kLoss = 0.3;
  BulkRig rig(testing::LossyChannelParams{.loss = kLoss, .seed = 11});
  std::mt19937 random(1);
  ASSERT_TRUE(rig.sender.offer(BulkKind::kPoints, random_bytes(random, kBulkObject)));
  int slots = 0;
  while (!rig.receiver.next()) {
    rig.step();
    ASSERT_LT(++slots, 1'000);
  }
  const double ideal_pieces = static_cast<double>(kBulkPieces) / (1 - kLoss);
  EXPECT_LT(static_cast<double>(rig.sender.counters().pieces), 1.15 * ideal_pieces);
  const double per_packet = static_cast<double>((rig.room - kBodyFixed) / kBulkPiece);
  EXPECT_LT(slots, 1.25 * ideal_pieces / per_packet + 20);
}

TEST(Bulk, GetsThroughWhereEveryPacketHasRoomForOnePieceOnly) {
  BulkRig rig(rough(0.3, 2));
  rig.room = kBodyFixed + BodyWriter::record_size(8 + kBulkPiece);
  std::mt19937 random(1);
  const Bytes bytes = random_bytes(random, 2'000);
  ASSERT_TRUE(rig.sender.offer(BulkKind::kLog, bytes));
  std::size_t seen = 0;
  for (int slot = 0; slot < 500; ++slot) {
    rig.step();
    while (const auto object = rig.receiver.next()) seen += same(object->bytes, bytes) ? 1U : 0U;
  }
  EXPECT_EQ(seen, 1U);
}

TEST(Bulk, TheKindsTakeTurns) {
  BulkRig rig(testing::LossyChannelParams{});
  rig.room = 300;
  std::mt19937 random(1);
  for (std::size_t kind = 0; kind < kBulkKinds; ++kind) {
    ASSERT_TRUE(rig.sender.offer(static_cast<BulkKind>(kind), random_bytes(random, 6'000)));
  }
  std::vector<int> came;
  for (int slot = 0; slot < 1'000; ++slot) {
    rig.step();
    while (rig.receiver.next()) came.push_back(slot);
  }
  ASSERT_EQ(came.size(), kBulkKinds);
  EXPECT_LT(came.back() - came.front(), came.front() / 4);
}

TEST(Bulk, BeginsAgainWithANewReceiver) {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    BulkRig rig(rough(0.3, seed));
    std::mt19937 random(seed);
    const Bytes bytes = random_bytes(random, 12'000);
    ASSERT_TRUE(rig.sender.offer(BulkKind::kPath, bytes));
    for (std::uint32_t slot = 0; slot < 5 + seed; ++slot) rig.step();
    rig.new_session();
    rig.receiver = {};
    rig.sender.peer_restarted();
    std::size_t seen = 0;
    for (int slot = 0; slot < 500; ++slot) {
      rig.step();
      while (const auto object = rig.receiver.next()) seen += same(object->bytes, bytes) ? 1U : 0U;
    }
    EXPECT_EQ(seen, 1U);
    EXPECT_TRUE(rig.sender.idle());
  }
}

TEST(Bulk, HearsANewSenderThatCountsFromTheBeginning) {
  BulkRig rig(testing::LossyChannelParams{});
  std::mt19937 random(1);
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(rig.sender.offer(BulkKind::kPath, random_bytes(random, 3'000)));
    for (int slot = 0; slot < 4; ++slot) rig.step();
  }
  rig.new_session();
  rig.sender = {};
  rig.receiver.peer_restarted();
  const Bytes bytes = random_bytes(random, 3'000);
  ASSERT_TRUE(rig.sender.offer(BulkKind::kPath, bytes));
  for (int slot = 0; slot < 20; ++slot) rig.step();
  const auto object = rig.receiver.next();
  ASSERT_TRUE(object);
  EXPECT_TRUE(same(object->bytes, bytes));
  EXPECT_EQ(rig.receiver.counters().superseded, 5U);
}

TEST(Bulk, RefusesNothingAndTooMuch) {
  BulkSender sender;
  EXPECT_FALSE(sender.offer(BulkKind::kPath, {}));
  EXPECT_FALSE(sender.offer(BulkKind::kPath, Bytes(kBulkObject + 1)));
  EXPECT_EQ(sender.counters().refused, 2U);
  EXPECT_TRUE(sender.idle());
}

// object, kind, total, first piece, bytes
Bytes piece(unsigned object, unsigned kind, std::size_t total, unsigned first, const Bytes& bytes) {
  Bytes record;
  const auto put = [&](std::size_t value, int size) {
    for (int i = 0; i < size; ++i) record.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  };
  put(object, 2);
  put(kind, 1);
  put(total, 3);
  put(first, 2);
  record.insert(record.end(), bytes.begin(), bytes.end());
  return record;
}

TEST(Bulk, BadPiecesAreCountedAndChangeNothing) {
  BulkReceiver receiver;
  const auto take = [&](const Bytes& bytes) {
    return receiver.take({RecordType::kBulk, bytes}, {});
  };
  // GIVEN an object of two pieces, the first of which came
  ASSERT_TRUE(take(piece(1, 0, 100, 0, Bytes(64))));
  // WHEN pieces come that no sender makes
  const std::vector<Bytes> bad{{},
                               piece(1, 0, 100, 0, {}),
                               piece(1, kBulkKinds, 100, 0, Bytes(64)),
                               piece(1, 0, 0, 0, Bytes(4)),
                               piece(1, 0, kBulkObject + 1, 0, Bytes(64)),
                               piece(1, 0, 101, 0, Bytes(64)),
                               piece(1, 0, 100, 2, Bytes(1)),
                               piece(1, 0, 100, 1, Bytes(39)),
                               piece(1, 0, 100, 1, Bytes(41)),
                               piece(1, 0, 100, 0, Bytes(63)),
                               piece(1, 0, 100, 0xFFFF, Bytes(64))};
  for (const Bytes& record : bad) EXPECT_FALSE(take(record));
  EXPECT_EQ(receiver.counters().malformed, bad.size());
  // THEN the object is completed as if they had not
  const std::uint32_t crc = bits::crc32_ieee(Bytes(100));
  Bytes rest(36);
  for (unsigned i = 0; i < 4; ++i) rest.push_back(static_cast<std::uint8_t>(crc >> (8 * i)));
  ASSERT_TRUE(take(piece(1, 0, 100, 1, rest)));
  EXPECT_EQ(receiver.next()->bytes.size(), 100U);
  // An older object is late, not bad.
  EXPECT_TRUE(take(piece(0, 0, 100, 0, Bytes(64))));
  EXPECT_EQ(receiver.counters().refused, 1U);
  EXPECT_FALSE(receiver.next());
}

TEST(Bulk, AnObjectThatDoesNotFitItsChecksumIsNotHandedOut) {
  BulkReceiver receiver;
  EXPECT_TRUE(receiver.take({RecordType::kBulk, piece(1, 0, 20, 0, Bytes(24))}, {}));
  EXPECT_EQ(receiver.counters().bad_checksum, 1U);
  EXPECT_FALSE(receiver.next());
}

TEST(Bulk, BadAcknowledgementsAreCountedAndChangeNothing) {
  BulkRig rig(testing::LossyChannelParams{});
  std::mt19937 random(1);
  ASSERT_TRUE(rig.sender.offer(BulkKind::kPath, random_bytes(random, 600)));  // ten pieces
  const auto take = [&](const Bytes& bytes) {
    return rig.sender.take({RecordType::kBulkAck, bytes}, {});
  };
  Bytes long_one(5 + kBulkWindow / 8 + 1, 0xFF);
  long_one[2] = 0;
  const std::vector<Bytes> bad{{1, 0, 0, 0},       {1, 0, kBulkKinds, 0, 0}, {1, 0, 0, 11, 0},
                               {1, 0, 0, 0, 0, 0}, {1, 0, 0, 8, 0, 2},       long_one};
  for (const Bytes& record : bad) EXPECT_FALSE(take(record));
  EXPECT_EQ(rig.sender.counters().malformed, bad.size());
  EXPECT_TRUE(take({2, 0, 0, 10, 0}));  // of another object
  EXPECT_TRUE(take({1, 0, 1, 10, 0}));  // of a kind that is idle
  EXPECT_FALSE(rig.sender.idle());
  EXPECT_TRUE(take({1, 0, 0, 10, 0}));
  EXPECT_TRUE(rig.sender.idle());
}

TEST(Bulk, AllocatesNothingAfterConstruction) {
  if (!testing::kAllocationsCounted) GTEST_SKIP() << "not counted under AddressSanitizer";
  BulkSender sender;
  BulkReceiver receiver;
  const Bytes bytes(kBulkObject, 7);
  Bytes buffer(kMaxBody);
  std::size_t seen = 0;
  const auto count = testing::allocations_of([&] {
    sender.offer(BulkKind::kPath, bytes);
    Instant now{};
    for (int slot = 0; slot < 100; ++slot, now += milliseconds(20)) {
      BodyWriter there(buffer, kMaxBody, Direction::kDown);
      there.begin(now, 1);
      sender.fill(there, kRoundTrip, now);
      const auto body = parse_body(there.bytes(), Direction::kDown);
      for (const Record& record : body->records) receiver.take(record, {});
      BodyWriter back(buffer, kMaxBody, Direction::kUp);
      back.begin(now, 1);
      receiver.fill(back, now);
      const auto answer = parse_body(back.bytes(), Direction::kUp);
      for (const Record& record : answer->records) sender.take(record, {});
      while (receiver.next()) ++seen;
    }
  });
  EXPECT_EQ(seen, 1U);
  EXPECT_EQ(count, 0U);
}

}  // namespace
}  // namespace pitwall::telemetry
