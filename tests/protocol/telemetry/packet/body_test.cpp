// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/packet/body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/support/allocation_guard.hpp"
#include "tests/support/reencode_body.hpp"
#include "tests/support/reference_body.hpp"

namespace pitwall::telemetry {
namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr std::array kDirections{Direction::kDown, Direction::kUp};
constexpr Instant kBodyTime{3'000'000'000'000};

std::vector<Group> groups_in(Direction direction) {
  std::vector<Group> all;
  for (const GroupRow& row : kGroupTable) {
    if (row.direction == direction) all.push_back(row.group);
  }
  return all;
}

std::size_t set_size(Direction direction) { return telemetry::set_size(own_layout(direction)); }

// A packet such as an end could send: anything of everything.
class RandomBody {
 public:
  explicit RandomBody(std::uint32_t seed) : random_(seed) {}

  std::size_t below(std::size_t n) { return random_() % n; }
  void shuffle(std::vector<Group>& groups) {
    for (std::size_t i = groups.size(); i > 1; --i) std::swap(groups[i - 1], groups[below(i)]);
  }
  Snapshot snapshot() {
    Snapshot snapshot;
    for (std::size_t i = 0; i < kFieldCount; ++i) {
      const FieldRow& row = kFields[i];
      if (below(8) == 0) continue;
      snapshot.values[i] =
          row.min + (static_cast<double>(below(12'001)) / 1e4 - 0.1) * (row.max - row.min);
    }
    for (Instant& at : snapshot.sampled_at) {
      if (below(8) != 0) at = kBodyTime - microseconds(static_cast<std::int64_t>(below(3'000'000)));
    }
    return snapshot;
  }
  Bytes bytes(Direction direction, std::size_t records) {
    Bytes buffer(kMaxBody, 0xEE);
    BodyWriter writer(buffer, kMaxBody, direction);
    writer.begin(kBodyTime, static_cast<std::uint8_t>(below(1U << kPaths)));
    if (below(2) == 0) {
      const auto newest = static_cast<std::uint16_t>(random_());
      const auto mask = static_cast<std::uint32_t>(random_());
      writer.add_ack({newest, mask, microseconds(static_cast<std::int64_t>(below(9'000'000)))});
    }
    std::vector<Group> wanted = groups_in(direction);
    shuffle(wanted);
    wanted.resize(below(wanted.size() + 1));
    CodecCounters counters;
    writer.add_groups(snapshot(), wanted, kBodyTime, counters);
    for (std::size_t i = 0; i < records; ++i) {
      Bytes payload(below(i == 0 ? 400 : 40));
      for (std::uint8_t& byte : payload) byte = static_cast<std::uint8_t>(random_());
      writer.add_record(static_cast<RecordType>(1 + below(kRecordTypeMax)), payload);
    }
    return {writer.bytes().begin(), writer.bytes().end()};
  }

 private:
  std::mt19937 random_;
};

// Refused by both readers, or read by both as the same and written again as it was.
bool agrees(const Bytes& bytes, Direction direction) {
  const auto body = parse_body(bytes, direction);
  const auto reference = testing::read_reference(bytes, direction);
  EXPECT_EQ(body.has_value(), reference.has_value());
  if (!body || !reference) return false;
  EXPECT_EQ(testing::reencode_body(*body, direction), bytes);
  EXPECT_EQ(body->tx_time_100us, reference->time);
  EXPECT_EQ(body->paths_mask, reference->paths);
  EXPECT_EQ(body->ack.has_value(), reference->has_ack);
  if (body->ack) {
    EXPECT_EQ(body->ack->newest_low, reference->newest);
    EXPECT_EQ(body->ack->mask, reference->mask);
    EXPECT_EQ(body->ack->hold, microseconds(100) * static_cast<std::int64_t>(reference->hold));
  }
  for (const GroupRow& row : kGroupTable) {
    EXPECT_EQ(body->groups.has(row.group), reference->ages.contains(row.group));
    if (!body->groups.has(row.group)) continue;
    EXPECT_EQ(body->age_codes[index_of(row.group)], reference->ages.at(row.group));
  }
  for (const auto& [field, value] : reference->values) {
    const double ours = body->values[field];
    EXPECT_TRUE(ours == value || (std::isnan(ours) && std::isnan(value))) << kFields[field].name;
  }
  EXPECT_EQ(body->records.size(), reference->records.size());
  for (std::size_t i = 0; i < body->records.size(); ++i) {
    const Record& record = body->records[i];
    EXPECT_EQ(static_cast<std::uint64_t>(record.type), reference->records[i].first);
    EXPECT_EQ(std::string(record.payload.begin(), record.payload.end()),
              reference->records[i].second);
  }
  return true;
}

TEST(Body, IsReadAsItWasWritten) {
  RandomBody random(1);
  for (int i = 0; i < 2'000; ++i) {
    for (const Direction direction : kDirections) {
      EXPECT_TRUE(agrees(random.bytes(direction, random.below(12)), direction));
    }
  }
}

TEST(Body, CutShortAnywhereIsRefusedOrEndsAtARecord) {
  RandomBody random(2);
  for (int i = 0; i < 10; ++i) {
    for (const Direction direction : kDirections) {
      const Bytes bytes = random.bytes(direction, 6);
      const auto whole = parse_body(bytes, direction);
      ASSERT_TRUE(whole);
      std::size_t ends = 0;
      for (std::size_t size = 0; size < bytes.size(); ++size) {
        ends +=
            agrees({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)}, direction)
                ? 1U
                : 0U;
      }
      EXPECT_EQ(ends, whole->records.size());
    }
  }
}

TEST(Body, EveryBitFlippedIsRefusedOrAnotherPacketInItsOneForm) {
  RandomBody random(3);
  for (int i = 0; i < 4; ++i) {
    for (const Direction direction : kDirections) {
      Bytes bytes = random.bytes(direction, 4);
      for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
        const auto mask = static_cast<std::uint8_t>(1U << (bit % 8));
        bytes[bit / 8] ^= mask;
        agrees(bytes, direction);
        bytes[bit / 8] ^= mask;
      }
    }
  }
}

TEST(Body, AnyBytesAtAllAreReadAlikeByBoth) {
  RandomBody random(4);
  for (int i = 0; i < 20'000; ++i) {
    Bytes bytes(random.below(60));
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.below(256));
    if (bytes.size() > 3) bytes[3] &= 0x0F;
    agrees(bytes, kDirections[random.below(2)]);
  }
}

TEST(BodyWriter, WritesTheGroupsThatFitInTheOrderThatIsAsked) {
  RandomBody random(5);
  const Snapshot snapshot = random.snapshot();
  for (std::size_t room = kBodyFixed; room < 220; ++room) {
    std::vector<Group> wanted = groups_in(Direction::kDown);
    random.shuffle(wanted);
    Bytes buffer(kMaxBody, 0);
    BodyWriter writer(buffer, room, Direction::kDown);
    writer.begin(kBodyTime, 1);
    CodecCounters counters;
    const GroupSet set = writer.add_groups(snapshot, wanted, kBodyTime, counters);
    EXPECT_LE(writer.bytes().size(), room);
    std::size_t bits = 0;
    for (const Group group : wanted) {
      const std::size_t more = bits + kAgeCodeBits + group_bits(group);
      const bool fits = kBodyFixed + set_size(Direction::kDown) + (more + 7) / 8 <= room;
      EXPECT_EQ(set.has(group), fits);
      if (fits) bits = more;
    }
    EXPECT_EQ(writer.bytes().size(),
              kBodyFixed + (set.empty() ? 0 : state_bytes(set, Direction::kDown)));
  }
}

TEST(BodyWriter, RefusesWhatHasNoRoom) {
  Bytes buffer(kMaxBody, 0);
  BodyWriter writer(buffer, kBodyFixed + kAckSize - 1, Direction::kUp);
  writer.begin(kBodyTime, 1);
  EXPECT_FALSE(writer.add_ack({}));
  EXPECT_FALSE(writer.add_record(RecordType::kEvent, Bytes(6)));
  EXPECT_TRUE(writer.add_record(RecordType::kEvent, Bytes(5)));
  EXPECT_EQ(writer.room_left(), 0U);

  BodyWriter many(buffer, kMaxBody, Direction::kUp);
  many.begin(kBodyTime, 1);
  for (std::size_t i = 0; i < kMaxRecords; ++i) {
    EXPECT_TRUE(many.add_record(RecordType::kEvent, {}));
  }
  EXPECT_FALSE(many.add_record(RecordType::kEvent, {}));
  EXPECT_TRUE(parse_body(many.bytes(), Direction::kUp));
}

TEST(BodyWriter, WritesAGroupThatIsAskedForTwiceOnce) {
  const std::array wanted{Group::kStop, Group::kStop};
  Bytes buffer(kMaxBody, 0);
  BodyWriter writer(buffer, kMaxBody, Direction::kUp);
  writer.begin(kBodyTime, 1);
  CodecCounters counters;
  writer.add_groups({}, wanted, kBodyTime, counters);
  EXPECT_TRUE(agrees({writer.bytes().begin(), writer.bytes().end()}, Direction::kUp));
}

BodyError body_error(const Bytes& bytes, Direction direction = Direction::kDown) {
  return parse_body(bytes, direction).error();
}

TEST(Body, EveryErrorHasItsCauseAndItsText) {
  EXPECT_EQ(body_error({0, 0, 0}), BodyError::kTooShort);
  EXPECT_EQ(body_error({0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}), BodyError::kTooShort);
  EXPECT_EQ(body_error({0, 0, 0, 0x10}), BodyError::kBadFlags);
  for (const Direction direction : kDirections) {
    const std::size_t groups = groups_in(direction).size();
    Bytes with_set(kBodyFixed + set_size(direction), 0);
    with_set[kBodyFixed - 1] = 2;
    EXPECT_EQ(body_error(with_set, direction), BodyError::kBadGroups);
    with_set[kBodyFixed] = 1;
    EXPECT_EQ(body_error(with_set, direction), BodyError::kTooShort);
    EXPECT_EQ(body_error({0, 0, 0, 2}, direction), BodyError::kTooShort);
    if (groups % 8 == 0) continue;
    with_set.back() = static_cast<std::uint8_t>(with_set.back() | 1U << (groups % 8));
    EXPECT_EQ(body_error(with_set, direction), BodyError::kBadGroups);
  }
  EXPECT_EQ(body_error({0, 0, 0, 0, 0, 0}), BodyError::kBadRecord);
  EXPECT_EQ(body_error({0, 0, 0, 0, kRecordTypeMax + 1, 0}), BodyError::kBadRecord);
  EXPECT_EQ(body_error({0, 0, 0, 0, 1}), BodyError::kBadRecord);
  EXPECT_EQ(body_error({0, 0, 0, 0, 1, 2, 0}), BodyError::kBadRecord);
  EXPECT_EQ(body_error({0, 0, 0, 0, 1, 0xF0}), BodyError::kBadRecord);
  EXPECT_EQ(body_error({0, 0, 0, 0, 1, 0xF0, 0xEF}), BodyError::kBadRecord);
  Bytes many(kBodyFixed, 0);
  for (std::size_t i = 0; i <= kMaxRecords; ++i) many.insert(many.end(), {1, 0});
  EXPECT_EQ(body_error(many), BodyError::kTooManyRecords);
  EXPECT_EQ(body_error(Bytes(kMaxBody + 1, 0)), BodyError::kTooLong);
  for (std::size_t e = 0; e < kBodyErrors; ++e) {
    EXPECT_FALSE(std::string(text_of(static_cast<BodyError>(e))).empty());
  }
}

TEST(Body, BitsThatNoValueMakesAndPaddingThatIsNotZeroAreRefused) {
  // GIVEN a packet with each group of the direction that has either
  std::size_t bad_values = 0, bad_padding = 0;
  for (const GroupRow& row : kGroupTable) {
    Bytes buffer(kMaxBody, 0);
    BodyWriter writer(buffer, kMaxBody, row.direction);
    writer.begin(kBodyTime, 1);
    CodecCounters counters;
    writer.add_groups({}, {&row.group, 1}, kBodyTime, counters);
    const Bytes bytes(writer.bytes().begin(), writer.bytes().end());
    // WHEN any bit of it is another
    for (std::size_t bit = 8 * kBodyFixed; bit < 8 * bytes.size(); ++bit) {
      Bytes other = bytes;
      other[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
      const auto body = parse_body(other, row.direction);
      if (body) continue;
      // THEN both kinds occur
      if (body.error() == BodyError::kBadValue) ++bad_values;
      if (body.error() == BodyError::kBadPadding) ++bad_padding;
    }
  }
  EXPECT_GT(bad_values, 0U);
  EXPECT_GT(bad_padding, 0U);
}

// Peers read a length as a varint: ten bytes of 0xFF left their mutex locked for good.
TEST(Body, TenBytesOfFFAsALengthAreRefusedAndTheNextPacketIsRead) {
  RandomBody random(6);
  const Bytes good = random.bytes(Direction::kDown, 2);
  Bytes bad{0, 0, 0, 0};
  bad.insert(bad.end(), 10, 0xFF);
  EXPECT_EQ(body_error(bad), BodyError::kBadRecord);
  bad = {0, 0, 0, 0, 1};
  bad.insert(bad.end(), 10, 0xFF);
  EXPECT_EQ(body_error(bad), BodyError::kBadRecord);
  EXPECT_TRUE(agrees(good, Direction::kDown));
}

// Peers parse their whole buffer whatever the datagram's length was.
TEST(Body, WhatABufferHoldsBehindTheDatagramIsNeverRead) {
  RandomBody random(7);
  for (int i = 0; i < 50; ++i) {
    const Bytes bytes = random.bytes(Direction::kDown, 0);
    Bytes buffer(2'048, 0xAA);
    std::copy(bytes.begin(), bytes.end(), buffer.begin());
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      // Whatever lies behind makes no difference to what the first bytes are.
      const bool one = parse_body(std::span(buffer).first(size), Direction::kDown).has_value();
      const Bytes alone(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_EQ(one, parse_body(alone, Direction::kDown).has_value());
    }
  }
}

// A peer published its old buffer again for a packet of one byte, and re-armed its watchdog by it.
TEST(Body, APacketOfOneByteIsRefusedAndGivesNoValues) {
  for (unsigned byte = 0; byte < 256; ++byte) {
    EXPECT_EQ(body_error({static_cast<std::uint8_t>(byte)}), BodyError::kTooShort);
  }
}

TEST(Body, NoBytesAndTheMostThatUdpCarriesAreRefused) {
  EXPECT_EQ(body_error({}), BodyError::kTooShort);
  EXPECT_EQ(body_error(Bytes(65'507, 0)), BodyError::kTooLong);
}

TEST(Body, AllocatesNothing) {
  if (!testing::kAllocationsCounted) GTEST_SKIP() << "not counted under AddressSanitizer";
  RandomBody random(8);
  const Snapshot snapshot = random.snapshot();
  const std::vector<Group> wanted = groups_in(Direction::kDown);
  Bytes buffer(kMaxBody, 0);
  bool read = false;
  const auto count = testing::allocations_of([&] {
    BodyWriter writer(buffer, kMaxBody, Direction::kDown);
    writer.begin(kBodyTime, 3);
    CodecCounters counters;
    writer.add_groups(snapshot, wanted, kBodyTime, counters);
    writer.add_record(RecordType::kEvent, std::span(buffer).first(20));
    read = parse_body(writer.bytes(), Direction::kDown).has_value();
  });
  EXPECT_TRUE(read);
  EXPECT_EQ(count, 0U);
}

}  // namespace
}  // namespace pitwall::telemetry
