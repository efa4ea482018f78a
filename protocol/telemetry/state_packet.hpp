// Whole state of the car in one datagram, for the bench, tools and tests on the same machine, which
// read it over the loopback. It is never sent over the radio, because it is neither authenticated
// nor within a budget; see endpoint/car_endpoint.hpp. It holds the groups of Direction::kDown only.
//   in     encode: values, sample ages (packet_of() makes both from a Snapshot), sequence, time of
//          sending. parse: any bytes
//   out    bytes in a buffer of the caller; a StatePacket
//   wire   "PW", version u8, flags u8, schema hash u32, run u32, sequence u32, sent u64 (little
//          endian), then bits, most significant first: sample age of each group of the car,
//          value of each of their fields; zeros to a whole byte; CRC-32 of all bytes before it,
//          little endian
//   units  microseconds on the car's monotonic clock; values as in the registry
//   errors PacketError; EncodeCounters. The CRC detects damage; it does not prove the origin
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

enum class Source : std::uint8_t { kCar, kSimulation };

inline constexpr std::uint8_t kWireVersion = 1;
inline constexpr unsigned kAgeBits = 24;  // microseconds, to 16.7 s; all ones: never sampled
inline constexpr Duration kMaxSampleAge = microseconds((std::int64_t{1} << kAgeBits) - 2);

inline constexpr std::size_t kHeaderBytes = 24, kChecksumBytes = 4;
inline constexpr std::size_t kStatePacketBytes =
    kHeaderBytes +
    (groups_of(Direction::kDown).count() * kAgeBits + bits_of(groups_of(Direction::kDown)) + 7) /
        8 +
    kChecksumBytes;

struct StatePacket {
  Source source = Source::kSimulation;
  std::uint32_t run = 0;       // changes with every start of the sender
  std::uint32_t sequence = 0;  // +1 per packet, wraps
  Instant sent{};              // the sender's clock; whole microseconds on the wire
  // Age of each group's sample when the packet was sent; negative: never sampled.
  std::array<Duration, kGroups> sample_age = [] {
    std::array<Duration, kGroups> never{};
    never.fill(microseconds(-1));
    return never;
  }();
  Values values;

  constexpr Duration& age_of(Group g) { return sample_age[index_of(g)]; }
  constexpr Duration age_of(Group g) const { return sample_age[index_of(g)]; }
};

// Values and ages of the car's groups at this moment; the caller sets source, run and sequence.
StatePacket packet_of(const Snapshot& snapshot, Instant now);

struct EncodeCounters {
  std::uint64_t packets = 0;
  std::uint64_t saturated = 0;   // values out of range, written as its nearest limit
  std::uint64_t not_finite = 0;  // infinite values, written as unset
};

using PacketBuffer = std::array<std::uint8_t, kStatePacketBytes>;

// Never fails. The result points into `buffer`.
std::span<const std::uint8_t> encode(const StatePacket& packet, PacketBuffer& buffer,
                                     EncodeCounters& counters);

enum class PacketError : std::uint8_t {
  kTooShort,
  kBadMagic,
  kBadChecksum,
  kOtherVersion,
  kOtherSchema,
  kWrongLength,
  kBadFlags,
  kBadCode
};
inline constexpr std::size_t kPacketErrors = 8;
const char* text_of(PacketError error);

Result<StatePacket, PacketError> parse(std::span<const std::uint8_t> bytes);

}  // namespace pitwall::telemetry
