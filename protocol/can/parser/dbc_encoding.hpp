// What the bytes of a DBC file are before anything in them is read: UTF-16 as some editors save it,
// or another kind of file altogether.
//   in      the bytes of a file
//   out     UTF-16 with a byte order mark as UTF-8; what a file looks like that is no DBC
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
  std::size_t broken = 0;           // characters that are none; U+FFFD stands for each
  std::size_t first_broken_at = 0;  // in `utf8`
};

// Nothing where the bytes do not begin with a byte order mark of UTF-16.
std::optional<Utf16Text> from_utf16(std::string_view bytes);

// "a candump log"; empty where a line begins with a section of a DBC file. UTF-8 or CP1252.
std::string_view kind_of_file(std::string_view bytes);

}  // namespace pitwall::can
