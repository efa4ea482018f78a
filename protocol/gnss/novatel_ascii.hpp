// Codec of NovAtel OEM7 ASCII logs: #NAMEA,header;fields*crc, and %NAMESA,week,seconds;fields*crc
// in short form. The logs and values are the same as in binary.
//   in     text between the sync character and ';', between ';' and '*'; a header and a message
//   out    header, values; a whole sentence with CRC and line end
//   errors DecodeError; nullopt for an invalid header. More fields than known are accepted (newer
//          firmware appends fields), fewer are not.
//   invariants
//          encoding and decoding gives the same values: numbers are written with as many digits as
//          they need, values without a name as decimal numbers
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

// Sets the response bit in message_type for a name that ends in R. An unknown log has id 0; a port
// that the binary header cannot express becomes 0, too.
std::optional<NovatelHeader> read_ascii_header(std::string_view text, bool short_form);

Result<NovatelMessage, DecodeError> decode_ascii(std::uint16_t id, std::string_view fields);

// Longest sentence of encode_ascii(): INSCONFIG with all entries and the longest numbers.
inline constexpr std::size_t kMaxAsciiBytes = 2'000;

// Writes name and form of the message. Returns the bytes written; `out` must have room for
// kMaxAsciiBytes. Stations must be printable and without quotes.
std::size_t encode_ascii(NovatelHeader header, const NovatelMessage& message,
                         std::span<std::uint8_t> out);

}  // namespace pitwall::gnss
