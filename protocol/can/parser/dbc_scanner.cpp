// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/parser/dbc_scanner.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "protocol/can/parser/dbc_statement.hpp"

namespace pitwall::can {
namespace {

constexpr std::string_view kSpace = " \t\r\n\f\v";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

// Length of the UTF-8 sequence at the front; 0 where there is none (RFC 3629 but for surrogates,
// which do no harm here).
std::size_t utf8_length(std::string_view t) {
  const auto lead = static_cast<unsigned char>(t[0]);
  const std::size_t size = lead < 0x80   ? 1
                           : lead < 0xC2 ? 0
                           : lead < 0xE0 ? 2
                           : lead < 0xF0 ? 3
                                         : 4;
  if (lead > 0xF4 || size > t.size()) return 0;
  for (std::size_t i = 1; i < size; ++i) {
    if ((static_cast<unsigned char>(t[i]) & 0xC0U) != 0x80U) return 0;
  }
  return size;
}

// Where the text stops being UTF-8; its size where it is all UTF-8.
std::size_t length_of_utf8(std::string_view t) {
  std::size_t at = 0;
  while (at < t.size()) {
    const std::size_t size = utf8_length(t.substr(at));
    if (size == 0) return at;
    at += size;
  }
  return at;
}

// Code points of 0x80 to 0x9F; the five unused ones stay what they are.
constexpr std::array<std::uint16_t, 32> kCp1252{
    0x20AC, 0x0081, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0x008D, 0x017D, 0x008F, 0x0090, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x009D, 0x017E, 0x0178};

void append_cp1252(std::string& out, char c) {
  const auto byte = static_cast<unsigned char>(c);
  const unsigned point = byte >= 0x80 && byte < 0xA0 ? kCp1252[byte - 0x80U] : byte;
  if (point < 0x80) {
    out += c;
  } else if (point < 0x800) {
    out += static_cast<char>(0xC0U | point >> 6U);
    out += static_cast<char>(0x80U | (point & 0x3FU));
  } else {
    out += static_cast<char>(0xE0U | point >> 12U);
    out += static_cast<char>(0x80U | (point >> 6U & 0x3FU));
    out += static_cast<char>(0x80U | (point & 0x3FU));
  }
}

}  // namespace

DbcScanner::DbcScanner(std::string_view text, std::string name)
    : text_(text), name_(std::move(name)), utf8_prefix_(length_of_utf8(text)) {
  if (text_.starts_with(kByteOrderMark)) at_ = kByteOrderMark.size();
}

bool DbcScanner::at_remark() const { return text_.substr(at_).starts_with("//"); }

void DbcScanner::skip_space() {
  do {
    const std::size_t next = text_.find_first_not_of(kSpace, at_);
    at_ = next == std::string_view::npos ? text_.size() : next;
    if (!at_remark()) return;
    skip_line();
  } while (true);
}

bool DbcScanner::at_end() {
  skip_space();
  return at_ >= text_.size();
}

char DbcScanner::peek() { return at_end() ? '\0' : text_[at_]; }

bool DbcScanner::take(char c) {
  if (at_end() || text_[at_] != c) return false;
  ++at_;
  return true;
}

void DbcScanner::expect(char c) {
  if (!take(c)) stop(std::string("expected '") + c + "'");
}

std::string_view DbcScanner::next_word() {
  skip_space();
  return first_word(text_.substr(at_));
}

std::string_view DbcScanner::word() {
  const std::string_view found = next_word();
  if (found.empty()) stop("expected a name");
  at_ += found.size();
  return found;
}

double DbcScanner::real() {
  skip_space();
  const bool has_plus = at_ + 1 < text_.size() && text_[at_] == '+' && text_[at_ + 1] != '-';
  double value = 0.0;
  const char* const begin = text_.data() + at_ + (has_plus ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
  if (error == std::errc::result_out_of_range) stop("this number is too large or too small");
  if (error != std::errc{} || !std::isfinite(value)) stop("expected a number");
  at_ = static_cast<std::size_t>(end - text_.data());
  return value;
}

std::string DbcScanner::expected(std::int64_t min, std::int64_t max) {
  return "expected a whole number from " + std::to_string(min) + " to " + std::to_string(max);
}

std::int64_t DbcScanner::integer(std::int64_t min, std::int64_t max, std::int64_t accepted) {
  skip_space();
  std::int64_t value = 0;
  const char* const begin = text_.data() + at_;
  const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
  if (error == std::errc::invalid_argument) stop("expected a whole number");
  if (error != std::errc{} || value < min || value > std::max(max, accepted)) {
    stop(expected(min, max));
  }
  at_ += static_cast<std::size_t>(end - begin);
  return value;
}

std::string_view DbcScanner::quoted() {
  const std::size_t begin = at_;
  expect('"');
  const std::size_t first = at_;
  for (;; ++at_) {
    at_ = text_.find_first_of("\"\\", at_);
    if (at_ == std::string_view::npos) {
      at_ = begin;
      stop("this text has no closing quote");
    }
    if (text_[at_] == '"') break;
    if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') ++at_;
  }
  const std::string_view between = text_.substr(first, at_++ - first);
  const std::size_t end = at_;
  if (peek() != ';' && holds_statement(text_.substr(first), between.size())) {
    at_ = begin;
    stop("this text has no closing quote");
  }
  at_ = end;
  return between;
}

std::string DbcScanner::string() {
  skip_space();
  const std::string_view between = quoted();
  std::string plain = utf8(between);
  if (plain.find('\\') == std::string::npos) return plain;
  std::string out;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    if (plain[i] == '\\' && i + 1 < plain.size() && plain[i + 1] == '"') continue;
    out += plain[i];
  }
  return out;
}

std::string DbcScanner::utf8(std::string_view taken) const {
  if (is_utf8() && taken.find('\r') == std::string_view::npos) return std::string{taken};
  std::string out;
  out.reserve(taken.size());
  for (std::size_t i = 0; i < taken.size(); ++i) {
    if (taken[i] == '\r') {
      if (!taken.substr(i + 1).starts_with('\n')) out += '\n';
    } else if (is_utf8()) {
      out += taken[i];
    } else {
      append_cp1252(out, taken[i]);
    }
  }
  return out;
}

std::string DbcScanner::string_or_word() {
  if (peek() == '"') return string();
  const std::size_t begin = at_;
  while (at_ < text_.size() && text_[at_] != ';' && kSpace.find(text_[at_]) == kSpace.npos) ++at_;
  return utf8(text_.substr(begin, at_ - begin));
}

std::string_view DbcScanner::statement() {
  const std::size_t begin = at_;
  while (true) {
    at_ = std::min(text_.find_first_of(";\"/\r\n", at_), text_.size());
    const char c = at_ < text_.size() ? text_[at_] : '\0';
    if (c == '"') {
      (void)quoted();
    } else if (c == '/' && !at_remark()) {
      ++at_;
    } else if (c != ';') {
      if (at_end() || at_statement()) break;
    } else {
      ++at_;
      break;
    }
  }
  return text_.substr(begin, at_ - begin);
}

std::string_view DbcScanner::since(std::size_t begin) const {
  const std::string_view passed = text_.substr(begin, at_ - begin);
  return passed.substr(0, passed.find_last_not_of(kSpace) + 1);
}

bool DbcScanner::at_statement() {
  return !at_end() && begins_line(at_) && begins_statement(text_.substr(at_));
}

bool DbcScanner::at_section() { return is_section(next_word()) && begins_line(at_); }

void DbcScanner::recover(std::size_t begin) {
  at_ = begin;
  const std::size_t end = std::min(text_.find_first_of("\r\n", begin), text_.size());
  for (std::size_t i = begin + 1; i < end; ++i) {
    const bool is_front = !is_word_character(text_[i - 1]) && is_word_character(text_[i]);
    if (!is_front || !begins_statement(text_.substr(i))) continue;
    at_ = i;
    return;
  }
  do {
    skip_line();
  } while (!at_end() && !at_section());
}

void DbcScanner::skip_line() {
  const std::size_t next = text_.find_first_of("\r\n", at_);
  at_ = next == std::string_view::npos ? text_.size() : next + 1;
}

std::size_t DbcScanner::here() {
  skip_space();
  return at_;
}

bool DbcScanner::begins_line(std::size_t offset) const {
  while (offset > 0 && (text_[offset - 1] == ' ' || text_[offset - 1] == '\t')) --offset;
  return offset == 0 || text_[offset - 1] == '\n' || text_[offset - 1] == '\r' ||
         (offset == kByteOrderMark.size() && text_.starts_with(kByteOrderMark));
}

// LF, CRLF, or CR alone.
bool DbcScanner::ends_line(std::size_t at) const {
  return text_[at] == '\n' || (text_[at] == '\r' && !text_.substr(at + 1).starts_with('\n'));
}

std::string DbcScanner::place_of(std::size_t offset) {
  for (; counted_to_ < offset; ++counted_to_) {
    if (ends_line(counted_to_)) ++line_, line_start_ = counted_to_ + 1;
  }
  const std::size_t line_before = line_;
  for (; counted_to_ > offset; --counted_to_) line_ -= ends_line(counted_to_ - 1) ? 1U : 0U;
  if (line_ != line_before) {
    line_start_ = offset;
    while (line_start_ > 0 && !ends_line(line_start_ - 1)) --line_start_;
  }
  return name_ + ":" + std::to_string(line_) + ":" + std::to_string(offset - line_start_ + 1);
}

void DbcScanner::stop(const std::string& what) { throw Stop{{place(), what}}; }

}  // namespace pitwall::can
