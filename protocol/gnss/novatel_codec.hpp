// Codec of NovAtel OEM7 logs: one whole log to values and back. Used by the car (decode) and by the
// bench, which simulates a receiver (encode).
//   in     a frame, binary or ASCII, that NovatelStream extracted and checked; a header and a
//          message
//   out    values; a complete binary frame with header and CRC (ASCII: novatel_ascii.hpp)
//   errors DecodeError (refusal.hpp). A body may be longer than known (newer firmware appends
//          fields), but not shorter.
//   source OEM7 Commands and Logs Reference Manual
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/gnss/novatel_message.hpp"
#include "protocol/gnss/refusal.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::gnss {

struct NovatelFrame {
  NovatelHeader header;
  std::span<const std::uint8_t> body;  // valid until the stream is fed again
  bool ascii = false;                  // then the body is the text between ';' and '*'
  std::size_t bytes = 0;               // of the whole frame, header and CRC included
};

Result<NovatelMessage, DecodeError> decode(const NovatelFrame& frame);

// Longest frame of encode().
inline constexpr std::size_t kMaxEncodedBytes = kLongHeaderBytes + InsConfig::kBytes + kCrcBytes;

// Writes header, body and CRC; id and form of the header follow from the message. Returns the bytes
// written; `out` must have room for kMaxEncodedBytes.
std::size_t encode(NovatelHeader header, const NovatelMessage& message,
                   std::span<std::uint8_t> out);

// Writes the header alone, for a body of body_bytes. For messages that this codec does not know.
std::size_t encode_header(const NovatelHeader& header, std::uint16_t body_bytes,
                          std::span<std::uint8_t> out);

}  // namespace pitwall::gnss
