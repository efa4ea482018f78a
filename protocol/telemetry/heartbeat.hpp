// What the base station says to the car ten times a second: that it lives, and what it heard last.
// The car learns from it that somebody watches, and how long a question and its answer take.
//   in     encode: a heartbeat. parse: any bytes at all
//   out    bytes in a buffer of the caller; a BaseHeartbeat
//   wire   "PH", version u8, flags u8 (0), run u32, sequence u32, sent u64; of the newest accepted
//          packet of state: its run u32, sequence u32, sent u64, and how long before this heartbeat
//          it was received, u32; CRC-32 of all before it. All little endian
//   units  microseconds; `sent` on the base's monotonic clock, `heard_sent` on the car's
//   errors PacketError. The CRC finds damage, it proves no origin: whoever can reach the car's
//          radio port can speak as its base, so this heartbeat grants nothing. It keeps a car from
//          stopping; it arms none. Keys come with the protocol that carries commands.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/telemetry/state_packet.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

inline constexpr std::uint8_t kHeartbeatVersion = 1;
inline constexpr std::size_t kHeartbeatBytes = 44;
inline constexpr Duration kHeartbeatPeriod = milliseconds(100);
inline constexpr Duration kMaxHeld =
    microseconds(0xFFFF'FFFF);  // 71 min; longer is written as this

struct BaseHeartbeat {
  std::uint32_t run = 0;       // of the base; another number after every start
  std::uint32_t sequence = 0;  // +1 per heartbeat, wraps
  Instant sent{};              // the base's clock; whole microseconds on the wire
  // The newest packet of state that the base accepted, and how long it had it.
  std::uint32_t heard_run = 0, heard_sequence = 0;
  Instant heard_sent{};  // the car's clock
  Duration held{};       // >= 0
};

using HeartbeatBuffer = std::array<std::uint8_t, kHeartbeatBytes>;

// Total: every heartbeat has bytes. The result lies in `buffer`.
std::span<const std::uint8_t> encode(const BaseHeartbeat& heartbeat, HeartbeatBuffer& buffer);

Result<BaseHeartbeat, PacketError> parse_heartbeat(std::span<const std::uint8_t> bytes);

}  // namespace pitwall::telemetry
