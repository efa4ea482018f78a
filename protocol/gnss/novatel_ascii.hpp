// NovAtel OEM7 ASCII: #NAMEA,header;fields*crc and, short, %NAMESA,week,seconds;fields*crc. The
// same logs and values as in binary.
//   in     text between the sync character and ';', between ';' and '*'; a header and a message
//   out    header, values; a whole sentence with CRC and line end
//   errors DecodeError; a header that is none gives nothing. More fields than we know are allowed
//          (newer firmware appends), fewer are not.
//   invariants
//          what is written reads back the same: numbers are written with as many digits as they
//          need, values without a name as decimal numbers
//   source OEM7 Commands and Logs Reference Manual: ASCII, Description of ASCII and Binary Logs
//          with Short Headers
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "protocol/gnss/novatel_message.hpp"
#include "protocol/gnss/refusal.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::gnss {

inline constexpr char kAsciiLong = '#', kAsciiShort = '%';

// Sets the bit of a response in message_type for a name that ends in R. The id of a log that we do
// not know is 0; a port that the binary header cannot name is 0, too.
std::optional<NovatelHeader> read_ascii_header(std::string_view text, bool short_form);

Result<NovatelMessage, DecodeError> decode_ascii(std::uint16_t id, std::string_view fields);

// The longest sentence that encode_ascii() writes: INSCONFIG with every entry, and every digit that
// a number can need.
inline constexpr std::size_t kMaxAsciiBytes = 2'000;

// Name and form follow from the message. Returns the bytes written; `out` must have room for
// kMaxAsciiBytes. Stations must be printable and without quotes.
std::size_t encode_ascii(NovatelHeader header, const NovatelMessage& message,
                         std::span<std::uint8_t> out);

}  // namespace pitwall::gnss
