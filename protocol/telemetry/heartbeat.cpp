// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/heartbeat.hpp"

#include <algorithm>
#include <optional>

#include "protocol/bits/crc.hpp"
#include "protocol/telemetry/little_endian.hpp"

namespace pitwall::telemetry {
namespace {

constexpr std::uint8_t kMagic0 = 'P', kMagic1 = 'H';
constexpr std::size_t kVersionAt = 2, kFlagsAt = 3, kRunAt = 4, kSequenceAt = 8, kSentAt = 12,
                      kHeardRunAt = 20, kHeardSequenceAt = 24, kHeardSentAt = 28, kHeldAt = 36,
                      kCovered = kHeartbeatBytes - kChecksumBytes;
static_assert(kHeldAt + sizeof(std::uint32_t) == kCovered);

std::uint64_t microseconds_of(Instant at) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(at.ns, 0) / 1'000);
}

// A time that no clock of ours can show is no time.
std::optional<Instant> instant_of(std::uint64_t us) {
  constexpr std::uint64_t kMax_us = 0x7FFF'FFFF'FFFF'FFFF / 1'000;
  if (us > kMax_us) return std::nullopt;
  return Instant{static_cast<std::int64_t>(us) * 1'000};
}

std::optional<PacketError> wrong_envelope(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kRunAt + kChecksumBytes) return PacketError::kTooShort;
  if (bytes[0] != kMagic0 || bytes[1] != kMagic1) return PacketError::kBadMagic;
  // First the checksum, so that damage is never taken for a base of another version.
  const std::size_t covered = bytes.size() - kChecksumBytes;
  if (bits::crc32_ieee(bytes.first(covered)) != load<std::uint32_t>(bytes, covered))
    return PacketError::kBadChecksum;
  if (bytes[kVersionAt] != kHeartbeatVersion) return PacketError::kOtherVersion;
  if (bytes.size() != kHeartbeatBytes) return PacketError::kWrongLength;
  if (bytes[kFlagsAt] != 0) return PacketError::kBadFlags;
  return std::nullopt;
}

}  // namespace

std::span<const std::uint8_t> encode(const BaseHeartbeat& heartbeat, HeartbeatBuffer& buffer) {
  const std::span<std::uint8_t> bytes{buffer};
  bytes[0] = kMagic0;
  bytes[1] = kMagic1;
  bytes[kVersionAt] = kHeartbeatVersion;
  bytes[kFlagsAt] = 0;
  store(bytes, kRunAt, heartbeat.run);
  store(bytes, kSequenceAt, heartbeat.sequence);
  store(bytes, kSentAt, microseconds_of(heartbeat.sent));
  store(bytes, kHeardRunAt, heartbeat.heard_run);
  store(bytes, kHeardSequenceAt, heartbeat.heard_sequence);
  store(bytes, kHeardSentAt, microseconds_of(heartbeat.heard_sent));
  const Duration held = std::clamp(heartbeat.held, Duration{}, kMaxHeld);
  store(bytes, kHeldAt, static_cast<std::uint32_t>(held.ns / 1'000));
  store(bytes, kCovered, bits::crc32_ieee(bytes.first(kCovered)));
  return bytes;
}

Result<BaseHeartbeat, PacketError> parse_heartbeat(std::span<const std::uint8_t> bytes) {
  if (const auto wrong = wrong_envelope(bytes)) return Unexpected{*wrong};
  const auto sent = instant_of(load<std::uint64_t>(bytes, kSentAt));
  const auto heard_sent = instant_of(load<std::uint64_t>(bytes, kHeardSentAt));
  if (!sent || !heard_sent) return Unexpected{PacketError::kBadCode};
  return BaseHeartbeat{
      .run = load<std::uint32_t>(bytes, kRunAt),
      .sequence = load<std::uint32_t>(bytes, kSequenceAt),
      .sent = *sent,
      .heard_run = load<std::uint32_t>(bytes, kHeardRunAt),
      .heard_sequence = load<std::uint32_t>(bytes, kHeardSequenceAt),
      .heard_sent = *heard_sent,
      .held = microseconds(static_cast<std::int64_t>(load<std::uint32_t>(bytes, kHeldAt)))};
}

}  // namespace pitwall::telemetry
