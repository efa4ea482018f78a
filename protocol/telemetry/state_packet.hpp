// Everything that the car tells, in one datagram for this machine only: the bench, tools and tests
// read it over the loopback. It never goes on the air: it is neither authentic nor within a budget;
// the radio is endpoint/car_endpoint.hpp. It holds the groups of Direction::kDown, no others.
//   in     encode: values, sample ages (packet_of() makes both of a Snapshot), sequence, time of
//          sending. parse: any bytes at all
//   out    bytes in a buffer of the caller; a StatePacket
//   wire   "PW", version u8, flags u8, schema hash u32, run u32, sequence u32, sent u64 (little
//          endian), then bits, most significant first: sample age of each group of the car,
//          value of each of their fields; zeros to a whole byte; CRC-32 of all before it, little
//          endian
//   units  microseconds on the car's monotonic clock; values as in the registry
//   errors PacketError; EncodeCounters. The CRC finds damage, it proves no origin.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/telemetry/registry/snapshot.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

enum class Source : std::uint8_t { kCar, kSimulation };

inline constexpr std::uint8_t kWireVersion = 1;
inline constexpr unsigned kAgeBits = 24;  // microseconds, to 16.7 s; all ones: never sampled
inline constexpr Duration kMaxSampleAge = microseconds((std::int64_t{1} << kAgeBits) - 2);

inline constexpr std::size_t kHeaderBytes = 24, kChecksumBytes = 4;
inline constexpr std::size_t kStatePacketBytes =
    kHeaderBytes + (groups_of(Direction::kDown).count() * kAgeBits + kValueBits + 7) / 8 +
    kChecksumBytes;
inline constexpr int kStateRate_hz = 50;

struct StatePacket {
  Source source = Source::kSimulation;
  std::uint32_t run = 0;       // another number after every start of the sender
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

// Values and ages of the car's groups at this moment; who sends it and its number are the caller's.
StatePacket packet_of(const Snapshot& snapshot, Instant now);

struct EncodeCounters {
  std::uint64_t packets = 0;
  std::uint64_t saturated = 0;   // values out of their range, written as its end
  std::uint64_t not_finite = 0;  // infinite values, written as unset
};

using PacketBuffer = std::array<std::uint8_t, kStatePacketBytes>;

// Total: every packet has bytes. The result lies in `buffer`.
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
