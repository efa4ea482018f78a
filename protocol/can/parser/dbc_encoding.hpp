// Detection of the encoding and the kind of a DBC file before parsing: UTF-16 as some editors save
// it, or another kind of file.
//   in      the bytes of a file
//   out     UTF-8 from UTF-16 with a byte order mark; the probable kind of a file that is not a DBC
//   source  RFC 2781 (UTF-16); the first bytes of each format as its own documentation gives them
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace pitwall::can {

struct Utf16Text {
  std::string utf8;
  bool is_little_endian = false;
  std::size_t broken = 0;           // invalid characters; U+FFFD replaces each
  std::size_t first_broken_at = 0;  // in `utf8`
};

// Empty if the bytes do not begin with a byte order mark of UTF-16.
std::optional<Utf16Text> from_utf16(std::string_view bytes);

// Example: "a candump log"; empty if a line begins with a section of a DBC file. UTF-8 or CP1252.
std::string_view kind_of_file(std::string_view bytes);

}  // namespace pitwall::can
