// Scanner of a DBC text: words, numbers and strings, each with its place. For the parser only.
//   in      text and its name
//   out     tokens on demand; a Stop (never leaves the parser) if the expected token is missing
//   errors  the place of a Stop is "file:line:column", counted from one in bytes
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::can {

inline constexpr std::int64_t kAnyInteger = std::numeric_limits<std::int64_t>::max();

class DbcScanner {
 public:
  // Thrown inside the parser and caught there; files are read at start-up only.
  struct Stop {
    Problem problem;
  };

  DbcScanner(std::string_view text, std::string name);

  bool at_end();
  // The next character that is not a space; '\0' at the end.
  char peek();
  bool take(char c);
  void expect(char c);
  std::string_view word();
  // The word that word() would return, without taking it; empty if there is none.
  std::string_view next_word();
  double real();
  // Also accepts numbers up to `accepted` if that is larger; a Stop names min and max.
  std::int64_t integer(std::int64_t min, std::int64_t max, std::int64_t accepted = 0);
  // Text of a Stop of integer().
  static std::string expected(std::int64_t min, std::int64_t max);
  std::string string();
  // A string, or the characters up to the next space or semicolon.
  std::string string_or_word();
  // Takes the text as written up to and with the next semicolon outside strings. If there is none:
  // up to the next statement at the beginning of a line, or to the end of the text.
  std::string_view statement();
  void skip_line();
  // Converts a part of the text to UTF-8 with LF.
  std::string utf8(std::string_view taken) const;
  // False if the text is not valid UTF-8; it is read as CP1252 then.
  bool is_utf8() const { return utf8_prefix_ == text_.size(); }
  std::size_t utf8_prefix() const { return utf8_prefix_; }

  std::size_t offset() const { return at_; }
  // Offset of the next token, for rewind() and place_of().
  std::size_t here();
  void rewind(std::size_t offset) { at_ = offset; }
  // The text from `begin` to the current offset, without trailing spaces.
  std::string_view since(std::size_t begin) const;
  // True if only spaces precede `offset` in its line.
  bool begins_line(std::size_t offset) const;
  // True if a statement (see dbc_statement) begins the line of the next token; at_section() is also
  // true if only its first word can be read.
  bool at_statement();
  bool at_section();
  // Moves to the statement after the one at `begin`, even if that one has no proper end.
  void recover(std::size_t begin);
  // The cost is the number of lines since the previous call, forwards or backwards.
  std::string place_of(std::size_t offset);
  std::string place() { return place_of(here()); }
  [[noreturn]] void stop(const std::string& what);

 private:
  // Skips spaces, line ends and remarks ("// ..." to the end of the line).
  void skip_space();
  bool at_remark() const;
  // Takes the string that begins here and returns the text between its quotes. A closing quote that
  // follows only after other statements belongs to another string.
  std::string_view quoted();
  bool ends_line(std::size_t at) const;

  std::string_view text_;
  std::string name_;
  std::size_t utf8_prefix_;
  std::size_t at_ = 0;
  // Result of the previous place_of().
  std::size_t counted_to_ = 0, line_ = 1, line_start_ = 0;
};

}  // namespace pitwall::can
