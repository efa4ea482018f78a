// Header of every datagram: the kind of packet and the session whose keys open it. It is
// authenticated with the rest, but not encrypted.
//   wire   u8 = version:3 | kind:3 | key phase:1 | 0:1, receiver u16, sequence (low half) u32;
//          little endian
//   in     any bytes
//   out    a Header, or HeaderError
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::telemetry {

inline constexpr std::uint8_t kProtocolVersion = 3;
inline constexpr std::size_t kHeaderSize = 7, kTagSize = 16;
inline constexpr std::size_t kMaxDatagram = 1'200;  // UDP payload; never an IP fragment
inline constexpr std::size_t kIpUdpOverhead = 28;   // IPv4 and UDP, counted in every budget
inline constexpr std::size_t kMaxBody = kMaxDatagram - kHeaderSize - kTagSize;

enum class Kind : std::uint8_t {
  kOpening,     // first message of the key exchange
  kAnswer,      // second
  kNewerStamp,  // reply to an opening whose stamp is too old: the stamp that the next must exceed
  kSealed,      // data, encrypted
  kSigned,      // data, readable, authenticated
  kUnknown      // reply: no session has that number; an unauthenticated hint
};
inline constexpr std::size_t kKinds = 6;

struct Header {
  Kind kind = Kind::kSealed;
  bool key_phase = false;
  std::uint16_t receiver = 0;      // the receiver's number of the session
  std::uint32_t sequence_low = 0;  // low half of 64 bits; the receiver restores the upper half
};

enum class HeaderError : std::uint8_t {
  kTooShort,
  kTooLong,
  kOtherVersion,
  kBadKind,
  kBadReserved
};
inline constexpr std::size_t kHeaderErrors = 5;
const char* text_of(HeaderError error);

Result<Header, HeaderError> parse_header(std::span<const std::uint8_t> datagram);
// `out` holds at least kHeaderSize bytes.
void write_header(const Header& header, std::span<std::uint8_t> out);

}  // namespace pitwall::telemetry
