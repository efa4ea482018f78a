// Splitter of a text log into lines, and parser of one line from left to right.
//
//   in     the whole text; lines end with LF, CR LF or CR, also mixed; a UTF-8 byte order mark at
//          the beginning is skipped
//   out    lines without their ends; whether a line has an end; numbers, words and bytes of a line
//   invariants
//          nothing is copied or allocated
//   errors the first syntax error: a column and a reason
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::replay {

// One line; `what` is the reason of the first syntax error, `at` its position.
struct TextLine {
  std::string_view text;
  std::size_t at = 0;
  const char* what = nullptr;

  bool done() const { return at == text.size(); }
  char peek() const { return at < text.size() ? text[at] : '\0'; }
  bool refuse(const char* reason) { return what = reason, false; }
  bool refuse_from(std::size_t place, const char* reason) { return at = place, refuse(reason); }
  bool take(char c, const char* reason) { return peek() == c ? (++at, true) : refuse(reason); }
  void skip_spaces() {
    while (peek() == ' ' || peek() == '\t') ++at;
  }
  bool at_space() const { return done() || peek() == ' ' || peek() == '\t'; }
  std::string_view word();  // up to the next space; empty at the end of the line
  std::string_view next_word() const;
};

class TextLines {
 public:
  explicit TextLines(std::string_view text);
  bool next();  // false after the last line
  std::string_view line() const { return line_; }
  std::size_t number() const { return number_; }
  bool has_end() const { return has_end_; }
  std::size_t position() const { return begin_; }  // byte offset of the next line

 private:
  std::string_view text_, line_;
  std::size_t begin_ = 0;  // offset of the next line
  std::size_t feed_ = 0;   // offset of the next LF at or after it; searched once
  std::size_t number_ = 0;
  bool has_end_ = false;
};

inline constexpr std::array<std::int8_t, 256> kHexValues = [] {
  std::array<std::int8_t, 256> out{};
  out.fill(-1);
  for (std::size_t i = 0; i < 10; ++i) out['0' + i] = static_cast<std::int8_t>(i);
  for (std::size_t i = 0; i < 6; ++i)
    out['a' + i] = out['A' + i] = static_cast<std::int8_t>(10 + i);
  return out;
}();
inline int hex_value(char c) { return kHexValues[static_cast<unsigned char>(c)]; }
inline bool is_digit(char c) { return c >= '0' && c <= '9'; }
inline char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
bool is_blank(std::string_view line);
bool starts_with_word(std::string_view text, std::string_view lower_word);  // ignoring case

// Reads a number of the given base, at most `most`; fails without a digit and above `most`.
bool read_unsigned(TextLine& line, unsigned base, std::uint64_t most, std::uint64_t& out);
// Reads "12.345678" in units of `unit_ns`, with '.' or ',' before the fraction; at most
// kMaxFractionDigits after it. Fails above kMaxStampSeconds.
inline constexpr int kMaxFractionDigits = 9;
inline constexpr std::int64_t kMaxStampSeconds = 8'999'999'999;  // the year 2255
bool read_decimal(TextLine& line, std::int64_t unit_ns, std::int64_t& out_ns);
// Reads two hex digits; fails with `reason`.
bool read_hex_byte(TextLine& line, std::uint8_t& out, const char* reason);

}  // namespace pitwall::replay
