// Detection of the beginnings of statements in a DBC text. A damaged statement has no reliable end,
// so the next one is found by its first word at the beginning of a line.
//   in      text from the first character of a line, without leading spaces
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

// The word at the front; empty if there is none.
std::string_view first_word(std::string_view text);

// True for a word that begins a statement, used or unused.
bool is_section(std::string_view word);
bool is_unused_section(std::string_view word);

// True if the text begins like a whole statement: "BO_ 100 M:", but not "BO_ 100 \"comment\"",
// which is the second line of a CM_.
bool begins_statement(std::string_view text);

// True if a number, a name and ':' follow the first word, as in "BO_ 100 M:".
bool reads_like_message(std::string_view text);

// True if a line within the first `size` characters, except the very first one, begins a statement:
// then a closing quote is missing.
bool holds_statement(std::string_view text, std::size_t size);

}  // namespace pitwall::can
