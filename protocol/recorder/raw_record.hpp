// Raw bytes of the radio and of a receiver as records of a recording.
//   /radio/down, /radio/up  message encoding "x-pitwall-datagram", one message per datagram, as
//                           received (authentic or not) or sent, still encrypted:
//                             u8  version, 1
//                             u8  path of the radio, from 0
//                             u16 port, u32 IPv4 address of the other end
//                             then the datagram. Numbers least significant byte first
//   /gnss/0, /gnss/1        message encoding "x-pitwall-stream": the bytes of one read from the
//                           receiver. Over UDP that is one datagram; otherwise the bytes of all
//                           messages in sequence are the byte stream of the receiver
//   errors  decode_datagram() returns nullopt for bytes that are not a datagram of this version
//   cost    no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::recorder {

inline constexpr const char* kDatagramEncoding = "x-pitwall-datagram";
inline constexpr const char* kStreamEncoding = "x-pitwall-stream";
inline constexpr std::size_t kDatagramHead = 8, kDatagramMax = 2'048;
inline constexpr std::uint8_t kDatagramVersion = 1;

struct RadioDatagram {
  std::uint8_t path = 0;
  std::uint32_t ip = 0;  // of the other end
  std::uint16_t port = 0;
  std::span<const std::uint8_t> bytes;
};
using DatagramBytes = std::array<std::uint8_t, kDatagramHead + kDatagramMax>;

// A datagram longer than kDatagramMax, longer than any of the radio, is cut there.
inline std::span<const std::uint8_t> encode(const RadioDatagram& datagram, DatagramBytes& bytes) {
  const std::size_t length = std::min(datagram.bytes.size(), kDatagramMax);
  bytes[0] = kDatagramVersion;
  bytes[1] = datagram.path;
  store(bytes, 2, datagram.port);
  store(bytes, 4, datagram.ip);
  std::ranges::copy(datagram.bytes.first(length), bytes.begin() + kDatagramHead);
  return std::span{bytes}.first(kDatagramHead + length);
}

inline std::optional<RadioDatagram> decode_datagram(std::span<const std::uint8_t> record) {
  if (record.size() < kDatagramHead || record[0] != kDatagramVersion) return std::nullopt;
  return RadioDatagram{.path = record[1],
                       .ip = load<std::uint32_t>(record, 4),
                       .port = load<std::uint16_t>(record, 2),
                       .bytes = record.subspan(kDatagramHead)};
}

}  // namespace pitwall::recorder
