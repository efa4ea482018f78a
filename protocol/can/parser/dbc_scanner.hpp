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
  std::int64_t integer(std::int64_t min, std::int64_t max);
  std::string string();
  // A string, or the characters up to the next space or semicolon.
  std::string string_or_word();
  // Up to and past the next semicolon outside strings, as it is written.
  std::string_view statement();
  void skip_line();
  // What was taken from the text as UTF-8 with LF.
  std::string utf8(std::string_view taken) const;

  std::size_t offset() const { return at_; }
  // Where the next token begins, for rewind() and place_of().
  std::size_t here();
  void rewind(std::size_t offset) { at_ = offset; }
  // True where only spaces stand before `offset` in its line.
  bool begins_line(std::size_t offset) const;
  // Costs the lines since the place that was asked for last, forwards or backwards.
  std::string place_of(std::size_t offset);
  std::string place() { return place_of(here()); }
  [[noreturn]] void stop(const std::string& what);

 private:
  // Spaces, line ends and remarks ("// ..." to the end of the line).
  void skip_space();
  bool at_remark() const;
  // Past the string that begins here; returns what is between its quotes.
  std::string_view quoted();
  bool ends_line(std::size_t at) const;

  std::string_view text_;
  std::string name_;
  bool is_utf8_;
  std::size_t at_ = 0;
  // Of the place that was asked for last.
  std::size_t counted_to_ = 0, line_ = 1, line_start_ = 0;
};

}  // namespace pitwall::can
