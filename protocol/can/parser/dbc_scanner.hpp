// The words, numbers and strings of a DBC text, each with its place. Used by the parser only.
//   in      text and its name
//   out     tokens on demand; a Stop (never leaves the parser) at the first thing that is not there
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
  // The word that word() would take; empty where none follows.
  std::string_view next_word();
  // Past a word, a string or one other character.
  void skip_token();
  double real();
  // Takes numbers up to `accepted` where that is more; a Stop names min and max.
  std::int64_t integer(std::int64_t min, std::int64_t max, std::int64_t accepted = 0);
  // What a Stop of integer() says.
  static std::string expected(std::int64_t min, std::int64_t max);
  std::string string();
  // A string, or the characters up to the next space or semicolon.
  std::string string_or_word();
  // Up to and past the next semicolon outside strings, as it is written. Without it, up to the next
  // statement at the beginning of a line, or to the end of the text.
  std::string_view statement();
  void skip_line();
  // What was taken from the text as UTF-8 with LF.
  std::string utf8(std::string_view taken) const;
  // False: the bytes are CP1252, because not all of them are UTF-8.
  bool is_utf8() const { return utf8_prefix_ == text_.size(); }
  std::size_t utf8_prefix() const { return utf8_prefix_; }

  std::size_t offset() const { return at_; }
  // Where the next token begins, for rewind() and place_of().
  std::size_t here();
  void rewind(std::size_t offset) { at_ = offset; }
  // The text from `begin` on that is passed, without the spaces at its end.
  std::string_view since(std::size_t begin) const;
  // True where only spaces stand before `offset` in its line.
  bool begins_line(std::size_t offset) const;
  // True where a statement (see dbc_statement) begins the line of the next token; the second also
  // where only its first word can be read.
  bool at_statement();
  bool at_section();
  // To the statement that follows the one at `begin`, however that one ends.
  void recover(std::size_t begin);
  // Costs the lines since the place that was asked for last, forwards or backwards.
  std::string place_of(std::size_t offset);
  std::string place() { return place_of(here()); }
  [[noreturn]] void stop(const std::string& what);

 private:
  // Spaces, line ends and remarks ("// ..." to the end of the line).
  void skip_space();
  bool at_remark() const;
  // Past the string that begins here; returns what is between its quotes. A closing quote that is
  // only found behind other statements closes another string.
  std::string_view quoted();
  bool ends_line(std::size_t at) const;

  std::string_view text_;
  std::string name_;
  std::size_t utf8_prefix_;
  std::size_t at_ = 0;
  // Of the place that was asked for last.
  std::size_t counted_to_ = 0, line_ = 1, line_start_ = 0;
};

}  // namespace pitwall::can
