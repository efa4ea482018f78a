// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/state_packet.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/bits/bit_stream.hpp"
#include "protocol/bits/crc.hpp"
#include "protocol/telemetry/registry/schema.hpp"
#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::telemetry {
namespace {

constexpr std::uint8_t kMagic0 = 'P', kMagic1 = 'W';
constexpr std::uint8_t kSimulationFlag = 0x01;
constexpr auto kLocalSchema = static_cast<std::uint32_t>(kSchemaHash ^ kSchemaHash >> 32U);
constexpr std::uint64_t kNoAge = (std::uint64_t{1} << kAgeBits) - 1;
constexpr std::size_t kVersionAt = 2, kFlagsAt = 3, kSchemaAt = 4, kRunAt = 8, kSequenceAt = 12,
                      kSentAt = 16;

std::uint64_t code_of(const bits::Quantized& field, double value, EncodeCounters& counters) {
  if (std::isinf(value)) {
    ++counters.not_finite;
    return field.no_value();
  }
  const bits::Encoded encoded = field.encode(value);
  if (encoded.saturated) ++counters.saturated;
  return encoded.step;
}

std::uint64_t code_of(Duration age) {
  if (age.ns < 0) return kNoAge;
  return static_cast<std::uint64_t>(std::min(age, kMaxSampleAge).ns / 1'000);
}

constexpr bool reported(Group group) { return row_of(group).direction == Direction::kDown; }

PacketError check_envelope(std::span<const std::uint8_t> bytes, bool& good) {
  good = false;
  if (bytes.size() < kHeaderBytes + kChecksumBytes) return PacketError::kTooShort;
  if (bytes[0] != kMagic0 || bytes[1] != kMagic1) return PacketError::kBadMagic;
  // First the checksum, so that damage is never taken for a sender of another version.
  const std::size_t covered = bytes.size() - kChecksumBytes;
  if (bits::crc32_ieee(bytes.first(covered)) != load<std::uint32_t>(bytes, covered)) {
    return PacketError::kBadChecksum;
  }
  if (bytes[kVersionAt] != kWireVersion) return PacketError::kOtherVersion;
  if (load<std::uint32_t>(bytes, kSchemaAt) != kLocalSchema) return PacketError::kOtherSchema;
  if (bytes.size() != kStatePacketBytes) return PacketError::kWrongLength;
  if ((bytes[kFlagsAt] & ~kSimulationFlag) != 0) return PacketError::kBadFlags;
  good = true;
  return {};
}

}  // namespace

StatePacket packet_of(const Snapshot& snapshot, Instant now) {
  StatePacket packet;
  packet.values = snapshot.values;
  for (const GroupRow& row : kGroupTable) {
    if (reported(row.group) && snapshot.ever(row.group))
      packet.age_of(row.group) = std::max(now - snapshot.at(row.group), Duration{});
  }
  return packet;
}

std::span<const std::uint8_t> encode(const StatePacket& packet, PacketBuffer& buffer,
                                     EncodeCounters& counters) {
  const std::span<std::uint8_t> bytes{buffer};
  bytes[0] = kMagic0;
  bytes[1] = kMagic1;
  bytes[kVersionAt] = kWireVersion;
  bytes[kFlagsAt] = packet.source == Source::kSimulation ? kSimulationFlag : 0;
  store(bytes, kSchemaAt, kLocalSchema);
  store(bytes, kRunAt, packet.run);
  store(bytes, kSequenceAt, packet.sequence);
  store(bytes, kSentAt, static_cast<std::uint64_t>(packet.sent.ns / 1'000));

  bits::BitWriter out{
      bytes.subspan(kHeaderBytes, kStatePacketBytes - kHeaderBytes - kChecksumBytes)};
  for (const GroupRow& row : kGroupTable) {
    if (reported(row.group)) out.write(code_of(packet.age_of(row.group)), kAgeBits);
  }
  for (FieldIndex i = 0; i < kFieldCount; ++i) {
    if (!reported(kFields[i].group)) continue;
    const bits::Quantized field = kFields[i].quantized();
    out.write(code_of(field, packet.values[i], counters), field.bits());
  }
  CHECK(out.align());

  const std::size_t covered = kStatePacketBytes - kChecksumBytes;
  store(bytes, covered, bits::crc32_ieee(bytes.first(covered)));
  ++counters.packets;
  return bytes;
}

Result<StatePacket, PacketError> parse(std::span<const std::uint8_t> bytes) {
  bool good = false;
  const PacketError reason = check_envelope(bytes, good);
  if (!good) return Unexpected{reason};

  StatePacket packet;
  packet.source = (bytes[kFlagsAt] & kSimulationFlag) != 0 ? Source::kSimulation : Source::kCar;
  packet.run = load<std::uint32_t>(bytes, kRunAt);
  packet.sequence = load<std::uint32_t>(bytes, kSequenceAt);
  constexpr std::uint64_t kMaxSent_us = 0x7FFF'FFFF'FFFF'FFFF / 1'000;  // fits Instant
  const std::uint64_t sent_us = load<std::uint64_t>(bytes, kSentAt);
  if (sent_us > kMaxSent_us) return Unexpected{PacketError::kBadCode};
  packet.sent = {static_cast<std::int64_t>(sent_us) * 1'000};

  bits::BitReader in{
      bytes.subspan(kHeaderBytes, kStatePacketBytes - kHeaderBytes - kChecksumBytes)};
  for (const GroupRow& row : kGroupTable) {
    if (!reported(row.group)) continue;
    const std::uint64_t code = in.read(kAgeBits);
    if (code != kNoAge) packet.age_of(row.group) = microseconds(static_cast<std::int64_t>(code));
  }
  for (FieldIndex i = 0; i < kFieldCount; ++i) {
    if (!reported(kFields[i].group)) continue;
    const bits::Quantized field = kFields[i].quantized();
    const std::uint64_t step = in.read(field.bits());
    if (step >= field.count() && step != field.no_value()) return Unexpected{PacketError::kBadCode};
    packet.values[i] = field.decode(step);
  }
  if (!in.align()) return Unexpected{PacketError::kBadCode};
  return packet;
}

const char* text_of(PacketError error) {
  switch (error) {
    case PacketError::kTooShort:
      return "too short";
    case PacketError::kBadMagic:
      return "not a pitwall packet";
    case PacketError::kBadChecksum:
      return "damaged";
    case PacketError::kOtherVersion:
      return "other wire version";
    case PacketError::kOtherSchema:
      return "other registry";
    case PacketError::kWrongLength:
      return "wrong length";
    case PacketError::kBadFlags:
      return "unknown flags";
    case PacketError::kBadCode:
      return "impossible value";
  }
  return "?";
}

}  // namespace pitwall::telemetry
