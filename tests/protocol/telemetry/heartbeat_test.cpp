// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/heartbeat.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "protocol/bits/crc.hpp"
#include "protocol/telemetry/little_endian.hpp"

namespace pitwall::telemetry {
namespace {

using Bytes = std::vector<std::uint8_t>;

BaseHeartbeat some_heartbeat() {
  return {.run = 0x01020304,
          .sequence = 0x05060708,
          .sent = {microseconds(0x0A0B0C0D0E0F).ns},
          .heard_run = 0x11121314,
          .heard_sequence = 0x15161718,
          .heard_sent = {microseconds(0x1A1B1C1D1E1F).ns},
          .held = microseconds(0x21222324)};
}

Bytes bytes_of(const BaseHeartbeat& heartbeat) {
  HeartbeatBuffer buffer;
  const auto bytes = encode(heartbeat, buffer);
  return {bytes.begin(), bytes.end()};
}

void seal(Bytes& bytes) {
  const std::size_t covered = bytes.size() - kChecksumBytes;
  store(std::span{bytes}, covered, bits::crc32_ieee(std::span{bytes}.first(covered)));
}

PacketError refusal(const Bytes& bytes) {
  const auto parsed = parse_heartbeat(bytes);
  EXPECT_FALSE(parsed.has_value());
  return parsed ? PacketError{} : parsed.error();
}

// Written out by hand from the layout in the header; the checksum is zlib.crc32's of Python.
TEST(BaseHeartbeat, HasTheBytesOfItsContract) {
  const Bytes expected{'P',  'H',  1,    0,                             //
                       0x04, 0x03, 0x02, 0x01,                          // run
                       0x08, 0x07, 0x06, 0x05,                          // sequence
                       0x0F, 0x0E, 0x0D, 0x0C, 0x0B, 0x0A, 0x00, 0x00,  // sent
                       0x14, 0x13, 0x12, 0x11,                          // heard run
                       0x18, 0x17, 0x16, 0x15,                          // heard sequence
                       0x1F, 0x1E, 0x1D, 0x1C, 0x1B, 0x1A, 0x00, 0x00,  // heard sent
                       0x24, 0x23, 0x22, 0x21,                          // held
                       0x66, 0xE4, 0xB1, 0x19};
  EXPECT_EQ(bytes_of(some_heartbeat()), expected);
}

TEST(BaseHeartbeat, ComesBackAsItWasToTheMicrosecond) {
  std::mt19937_64 random{1};
  for (int round = 0; round < 2'000; ++round) {
    const auto time = [&] { return Instant{static_cast<std::int64_t>(random() >> 1U)}; };
    const BaseHeartbeat sent{.run = static_cast<std::uint32_t>(random()),
                             .sequence = static_cast<std::uint32_t>(random()),
                             .sent = time(),
                             .heard_run = static_cast<std::uint32_t>(random()),
                             .heard_sequence = static_cast<std::uint32_t>(random()),
                             .heard_sent = time(),
                             .held = {static_cast<std::int64_t>(random() % 4'000'000'000'000)}};
    const auto got = parse_heartbeat(bytes_of(sent));
    ASSERT_TRUE(got);
    EXPECT_EQ(got->run, sent.run);
    EXPECT_EQ(got->sequence, sent.sequence);
    EXPECT_EQ(got->heard_run, sent.heard_run);
    EXPECT_EQ(got->heard_sequence, sent.heard_sequence);
    EXPECT_EQ(got->sent.ns, sent.sent.ns / 1'000 * 1'000);
    EXPECT_EQ(got->heard_sent.ns, sent.heard_sent.ns / 1'000 * 1'000);
    EXPECT_EQ(got->held.ns, sent.held.ns / 1'000 * 1'000);
  }
}

TEST(BaseHeartbeat, EncodingIsTotal) {
  BaseHeartbeat odd = some_heartbeat();
  odd.sent = odd.heard_sent = {-5};
  odd.held = {-1};
  EXPECT_EQ(parse_heartbeat(bytes_of(odd))->held, Duration{});
  EXPECT_EQ(parse_heartbeat(bytes_of(odd))->sent, Instant{});
  odd.held = seconds(1'000'000);
  EXPECT_EQ(parse_heartbeat(bytes_of(odd))->held, kMaxHeld);
}

TEST(BaseHeartbeat, EveryFlippedBitIsRefused) {
  const Bytes good = bytes_of(some_heartbeat());
  for (std::size_t bit = 0; bit < good.size() * 8; ++bit) {
    Bytes bad = good;
    bad[bit / 8] = static_cast<std::uint8_t>(bad[bit / 8] ^ (1U << (bit % 8)));
    EXPECT_EQ(refusal(bad), bit < 16 ? PacketError::kBadMagic : PacketError::kBadChecksum) << bit;
  }
}

TEST(BaseHeartbeat, EveryTruncationAndExtensionIsRefused) {
  const Bytes good = bytes_of(some_heartbeat());
  for (std::size_t keep = 0; keep < good.size(); ++keep) {
    const Bytes cut{good.begin(), good.begin() + static_cast<std::ptrdiff_t>(keep)};
    EXPECT_EQ(refusal(cut), keep < 8 ? PacketError::kTooShort : PacketError::kBadChecksum);
  }
  Bytes longer = good;
  longer.push_back(0);
  EXPECT_EQ(refusal(longer), PacketError::kBadChecksum);
  seal(longer);
  EXPECT_EQ(refusal(longer), PacketError::kWrongLength);
}

TEST(BaseHeartbeat, SealedNonsenseIsRefusedByKind) {
  const auto with = [](std::size_t at, std::uint8_t value) {
    Bytes bytes = bytes_of(some_heartbeat());
    bytes[at] = value;
    seal(bytes);
    return refusal(bytes);
  };
  EXPECT_EQ(with(2, 2), PacketError::kOtherVersion);
  EXPECT_EQ(with(3, 1), PacketError::kBadFlags);
  EXPECT_EQ(with(19, 0xFF), PacketError::kBadCode);  // sent in the year 292 000
  EXPECT_EQ(with(35, 0xFF), PacketError::kBadCode);
}

// A packet of state that comes back is no heartbeat, and the other way round.
TEST(BaseHeartbeat, IsNeverTakenForAPacketOfState) {
  PacketBuffer buffer;
  EncodeCounters counters;
  const auto state = encode(StatePacket{}, buffer, counters);
  EXPECT_EQ(refusal({state.begin(), state.end()}), PacketError::kBadMagic);
  EXPECT_FALSE(parse(bytes_of(some_heartbeat())));
}

TEST(BaseHeartbeat, RandomBytesAreRefused) {
  std::mt19937_64 random{2};
  for (int round = 0; round < 20'000; ++round) {
    Bytes bytes(random() % (2 * kHeartbeatBytes));
    for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random());
    EXPECT_FALSE(parse_heartbeat(bytes));
  }
}

}  // namespace
}  // namespace pitwall::telemetry
