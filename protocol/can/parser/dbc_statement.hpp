// Where the statements of a DBC text begin. A damaged statement has no certain end, so that the
// next one is found by its first word at the beginning of a line.
//   in      text from the first character of a line, spaces removed
//   source  Vector, "DBC File Format Documentation" 1.0
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace pitwall::can {

constexpr bool is_word_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}

// The word at the front; empty where none is.
std::string_view first_word(std::string_view text);

// A word that begins a statement, whether the statement is read or has no use here.
bool is_section(std::string_view word);
bool is_unused_section(std::string_view word);

// True where the front reads like a whole statement: "BO_ 100 M:", not "BO_ 100 \"comment\"", which
// is the second line of a CM_.
bool begins_statement(std::string_view text);

// True where a number, a name and ':' follow the first word, as in "BO_ 100 M:".
bool reads_like_message(std::string_view text);

// True where a line that begins within the first `size` characters, but for the very first line,
// begins a statement: a closing quote is missing.
bool holds_statement(std::string_view text, std::size_t size);

}  // namespace pitwall::can
