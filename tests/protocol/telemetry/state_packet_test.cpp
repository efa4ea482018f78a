// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/state_packet.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "protocol/bits/crc.hpp"
#include "protocol/vocabulary/random.hpp"

namespace pitwall::telemetry {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kDownGroups = groups_of(Direction::kDown).count();
constexpr bool reported(FieldIndex i) {
  return row_of(kFields[i].group).direction == Direction::kDown;
}

Bytes bytes_of(const StatePacket& packet) {
  PacketBuffer buffer;
  EncodeCounters counters;
  const auto bytes = encode(packet, buffer, counters);
  return {bytes.begin(), bytes.end()};
}

void seal(Bytes& bytes) {
  const std::size_t covered = bytes.size() - kChecksumBytes;
  const std::uint32_t crc = bits::crc32_ieee(std::span{bytes}.first(covered));
  for (std::size_t i = 0; i < 4; ++i) {
    bytes[covered + i] = static_cast<std::uint8_t>(crc >> (8 * i));
  }
}

PacketError refusal(const Bytes& bytes) {
  const auto parsed = parse(bytes);
  EXPECT_FALSE(parsed.has_value());
  return parsed ? PacketError{} : parsed.error();
}

// Every field at a different place of its range; every third unset.
StatePacket some_packet() {
  StatePacket p;
  p.source = Source::kCar;
  p.run = 0xCAFE, p.sequence = 0x01020304;
  p.sent = Instant{microseconds(0x0A0B0C0D0E0F).ns};
  for (std::size_t g = 0; g < kGroups; ++g) {
    p.sample_age[g] = microseconds(static_cast<std::int64_t>(g) * 1'000 - 1);
  }
  for (FieldIndex i = 0; i < kFieldCount; ++i) {
    if (i % 3 == 2) continue;
    const FieldRow& row = kFields[i];
    const auto code = static_cast<double>((i * 2'654'435'761ULL) % row.quantized().count());
    p.values[i] = row.min + code * row.resolution;
  }
  return p;
}

TEST(StatePacket, EveryValueArrivesWithinHalfItsResolution) {
  Random random;
  for (int round = 0; round < 300; ++round) {
    StatePacket sent = some_packet();
    sent.sequence = static_cast<std::uint32_t>(random.next());
    for (FieldIndex i = 0; i < kFieldCount; ++i) {
      const FieldRow& row = kFields[i];
      sent.values[i] =
          random.next() % 8 == 0 ? kUnset : row.min + random.uniform() * (row.max - row.min);
    }
    const auto got = parse(bytes_of(sent));
    ASSERT_TRUE(got.has_value());
    EXPECT_EQ(got->source, sent.source);
    EXPECT_EQ(got->run, sent.run);
    EXPECT_EQ(got->sequence, sent.sequence);
    EXPECT_EQ(got->sent, sent.sent);
    for (FieldIndex i = 0; i < kFieldCount; ++i) {
      const FieldRow& row = kFields[i];
      if (std::isnan(sent.values[i]) || !reported(i)) {
        EXPECT_TRUE(std::isnan(got->values[i])) << row.name;
      } else {
        EXPECT_NEAR(got->values[i], sent.values[i], 0.5 * row.resolution * (1.0 + 1e-6))
            << row.name;
      }
    }
  }
}

TEST(StatePacket, WhatWasParsedEncodesToTheSameBytes) {
  const Bytes first = bytes_of(some_packet());
  const auto parsed = parse(first);
  ASSERT_TRUE(parsed.has_value());
  EXPECT_EQ(bytes_of(*parsed), first);
}

TEST(StatePacket, SampleAgesArriveAndNeverStaysNever) {
  StatePacket sent;
  sent.age_of(Group::kEgo) = microseconds(1'234);
  sent.age_of(Group::kTyres) = seconds(100);
  const auto got = parse(bytes_of(sent));
  ASSERT_TRUE(got.has_value());
  EXPECT_EQ(got->age_of(Group::kEgo), microseconds(1'234));
  EXPECT_EQ(got->age_of(Group::kTyres), kMaxSampleAge);
  EXPECT_LT(got->age_of(Group::kMode).ns, 0);
}

// What the base says to the car is not the car's to tell.
TEST(StatePacket, HoldsTheGroupsOfTheCarAndNoOthers) {
  Snapshot snapshot;
  const Instant now = Instant{} + seconds(5);
  snapshot.values.at.fill(1.0);
  snapshot.sampled_at.fill(now - milliseconds(30));
  const auto got = parse(bytes_of(packet_of(snapshot, now)));
  ASSERT_TRUE(got.has_value());
  for (const GroupRow& row : kGroupTable) {
    const bool down = row.direction == Direction::kDown;
    EXPECT_EQ(got->age_of(row.group), down ? milliseconds(30) : microseconds(-1)) << row.name;
  }
  for (FieldIndex i = 0; i < kFieldCount; ++i)
    EXPECT_EQ(std::isnan(got->values[i]), !reported(i)) << kFields[i].name;
}

TEST(StatePacket, OfASnapshotHasNoAgeWhereNothingWasSampledAndNoneBelowZero) {
  Snapshot snapshot;
  const Instant now = Instant{} + seconds(5);
  snapshot.at(Group::kEgo) = now + milliseconds(3);
  const StatePacket packet = packet_of(snapshot, now);
  EXPECT_EQ(packet.age_of(Group::kEgo), Duration{});
  EXPECT_LT(packet.age_of(Group::kMode).ns, 0);
}

TEST(StatePacket, ValuesOutOfRangeAreWrittenAsTheEndAndCounted) {
  PacketBuffer buffer;
  EncodeCounters counters;
  StatePacket p;
  p.values[field("wheels.front_left")] = 1e9;
  p.values[field("ego.vx")] = -1e9;
  p.values[field("ego.x")] = std::numeric_limits<double>::infinity();
  const auto got = parse(encode(p, buffer, counters));
  ASSERT_TRUE(got.has_value());
  EXPECT_EQ(got->values[field("wheels.front_left")], kFields[field("wheels.front_left")].max);
  EXPECT_EQ(got->values[field("ego.vx")], kFields[field("ego.vx")].min);
  EXPECT_TRUE(std::isnan(got->values[field("ego.x")]));
  EXPECT_EQ(counters.saturated, 2U);
  EXPECT_EQ(counters.not_finite, 1U);
}

TEST(StatePacket, EveryFlippedBitIsRefused) {
  const Bytes good = bytes_of(some_packet());
  for (std::size_t bit = 0; bit < good.size() * 8; ++bit) {
    Bytes bad = good;
    bad[bit / 8] = static_cast<std::uint8_t>(bad[bit / 8] ^ (1U << (bit % 8)));
    const PacketError expected = bit < 16 ? PacketError::kBadMagic : PacketError::kBadChecksum;
    EXPECT_EQ(refusal(bad), expected) << "bit " << bit;
  }
}

TEST(StatePacket, EveryTruncationAndExtensionIsRefused) {
  const Bytes good = bytes_of(some_packet());
  for (std::size_t keep = 0; keep < good.size(); ++keep) {
    Bytes cut{good.begin(), good.begin() + static_cast<std::ptrdiff_t>(keep)};
    EXPECT_EQ(refusal(cut), keep < kHeaderBytes + kChecksumBytes ? PacketError::kTooShort
                                                                 : PacketError::kBadChecksum);
  }
  Bytes longer = good;
  longer.push_back(0);
  EXPECT_EQ(refusal(longer), PacketError::kBadChecksum);
  seal(longer);
  EXPECT_EQ(refusal(longer), PacketError::kWrongLength);
}

// What a correct checksum does not excuse.
TEST(StatePacket, SealedNonsenseIsRefusedByKind) {
  const Bytes good = bytes_of(StatePacket{});
  const auto with = [&](std::size_t at, std::uint8_t value) {
    Bytes bytes = good;
    bytes[at] = value;
    seal(bytes);
    return refusal(bytes);
  };
  EXPECT_EQ(with(2, 99), PacketError::kOtherVersion);
  EXPECT_EQ(with(3, 0x83), PacketError::kBadFlags);
  EXPECT_EQ(with(4, static_cast<std::uint8_t>(good[4] ^ 1U)), PacketError::kOtherSchema);
  EXPECT_EQ(with(23, 0xFF), PacketError::kBadCode);  // sent in the year 292 000
  if ((kDownGroups * kAgeBits + bits_of(groups_of(Direction::kDown))) % 8 != 0) {
    const std::size_t last = good.size() - kChecksumBytes - 1;
    EXPECT_EQ(with(last, static_cast<std::uint8_t>(good[last] | 1U)), PacketError::kBadCode);
  }
  // track.lap has ten for 0 to 1000: 1001 to 1022 are no laps.
  Bytes bytes = good;
  std::size_t at_bit = 8 * kHeaderBytes + kDownGroups * kAgeBits;
  for (FieldIndex i = 0; i < field("track.lap"); ++i) at_bit += kFields[i].quantized().bits();
  ASSERT_EQ(kFields[field("track.lap")].quantized().bits(), 10U);
  for (std::size_t bit = at_bit, mask = 1'022 << 6U; bit < at_bit + 10; ++bit, mask <<= 1U) {
    const auto one = static_cast<std::uint8_t>(0x80U >> (bit % 8));
    const std::uint8_t was = bytes[bit / 8];
    bytes[bit / 8] = static_cast<std::uint8_t>((mask & 0x8000U) != 0 ? was | one : was & ~one);
  }
  seal(bytes);
  EXPECT_EQ(refusal(bytes), PacketError::kBadCode);
}

TEST(StatePacket, RandomBytesNeverCrash) {
  Random random;
  int accepted = 0;
  for (int round = 0; round < 20'000; ++round) {
    Bytes bytes(random.next() % (2 * kStatePacketBytes));
    for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random.next() >> 24U);
    if (parse(bytes)) ++accepted;
  }
  EXPECT_EQ(accepted, 0);
}

TEST(StatePacket, RandomBitsInASealedPacketAreRefusedOrCanonical) {
  Random random;
  int accepted = 0;
  for (int round = 0; round < 20'000; ++round) {
    Bytes bytes = bytes_of(some_packet());
    for (int k = 0; k < 3; ++k) {
      const std::size_t at = kHeaderBytes + random.next() % (bytes.size() - kHeaderBytes);
      bytes[at] = static_cast<std::uint8_t>(random.next() >> 24U);
    }
    seal(bytes);
    const auto parsed = parse(bytes);
    if (!parsed) continue;
    ++accepted;
    ASSERT_EQ(bytes_of(*parsed), bytes);
  }
  EXPECT_GT(accepted, 0);
}

TEST(StatePacket, EveryRefusalHasAText) {
  for (std::size_t i = 0; i < kPacketErrors; ++i) {
    EXPECT_STRNE(text_of(static_cast<PacketError>(i)), "?");
  }
}

std::string hex(const Bytes& bytes) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    text += kDigits[bytes[i] >> 4U];
    text += kDigits[bytes[i] & 15U];
    text += i % 32 == 31 ? "\n" : "";
  }
  return text + "\n";
}

// Golden vectors: an intended change of the wire shows as a change of these files
// (PITWALL_WRITE_GOLDEN=1 writes them).
TEST(StatePacket, GoldenVectors) {
  const std::pair<const char*, StatePacket> cases[] = {{"state_empty.hex", StatePacket{}},
                                                       {"state_some.hex", some_packet()}};
  for (const auto& [name, packet] : cases) {
    const std::string path = std::string{PITWALL_SOURCE_DIR "/tests/golden/telemetry/"} + name;
    const std::string now = hex(bytes_of(packet));
    if (std::getenv("PITWALL_WRITE_GOLDEN") != nullptr) std::ofstream{path} << now;
    std::ifstream in{path};
    const std::string golden{std::istreambuf_iterator<char>{in}, {}};
    EXPECT_EQ(now, golden) << path;
  }
}

}  // namespace
}  // namespace pitwall::telemetry
