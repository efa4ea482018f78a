// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/text_line.hpp"

#include <algorithm>

namespace pitwall::replay {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

}  // namespace

std::string_view TextLine::word() {
  skip_spaces();
  const std::size_t begin = at;
  while (!at_space()) ++at;
  return text.substr(begin, at - begin);
}

std::string_view TextLine::next_word() const {
  TextLine ahead = *this;
  return ahead.word();
}

TextLines::TextLines(std::string_view text) : text_(text) {
  if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
  feed_ = std::min(text_.find('\n'), text_.size());
}

bool TextLines::next() {
  if (begin_ == text_.size()) return false;
  ++number_;
  if (feed_ < begin_) feed_ = std::min(text_.find('\n', begin_), text_.size());
  const std::string_view to_feed = text_.substr(begin_, feed_ - begin_);
  const std::size_t length = std::min(to_feed.find('\r'), to_feed.size());
  line_ = to_feed.substr(0, length);
  const std::size_t end = begin_ + length;
  has_end_ = end < text_.size();
  const bool is_both = end + 1 == feed_ && feed_ < text_.size();  // CR LF
  begin_ = end + (is_both ? 2U : has_end_ ? 1U : 0U);
  return true;
}

bool is_blank(std::string_view line) {
  return line.find_first_not_of(" \t") == std::string_view::npos;
}

bool starts_with_word(std::string_view text, std::string_view lower_word) {
  return text.size() >= lower_word.size() &&
         std::equal(lower_word.begin(), lower_word.end(), text.begin(),
                    [](char wanted, char got) { return wanted == lower(got); });
}

bool read_unsigned(TextLine& line, unsigned base, std::uint64_t most, std::uint64_t& out) {
  const std::size_t begin = line.at;
  out = 0;
  while (!line.done()) {
    const int digit = hex_value(line.peek());
    if (digit < 0 || digit >= static_cast<int>(base)) break;
    out = out * base + static_cast<unsigned>(digit);
    if (out > most) return line.refuse_from(begin, "number out of range");
    ++line.at;
  }
  return line.at > begin || line.refuse("expected a number");
}

bool read_decimal(TextLine& line, std::int64_t unit_ns, std::int64_t& out_ns) {
  const std::size_t begin = line.at;
  const auto most =
      static_cast<std::uint64_t>(kMaxStampSeconds * (kNanosecondsPerSecond / unit_ns));
  std::uint64_t whole = 0;
  if (!read_unsigned(line, 10, most, whole)) return line.refuse_from(begin, "expected a stamp");
  std::int64_t fraction = 0, scale = 1;
  if (line.peek() == '.' || line.peek() == ',') {
    ++line.at;
    int places = 0;
    for (; is_digit(line.peek()) && places < kMaxFractionDigits; ++line.at, ++places) {
      fraction = fraction * 10 + (line.peek() - '0');
      scale *= 10;
    }
    if (places == 0) return line.refuse("expected the fraction of a stamp");
    if (is_digit(line.peek())) return line.refuse("a stamp has at most 9 digits of fraction");
  }
  // The unit is a power of ten of nanoseconds: only digits below one nanosecond are dropped.
  const std::int64_t fraction_ns =
      scale <= unit_ns ? fraction * (unit_ns / scale) : fraction / (scale / unit_ns);
  out_ns = static_cast<std::int64_t>(whole) * unit_ns + fraction_ns;
  return true;
}

bool read_hex_byte(TextLine& line, std::uint8_t& out, const char* reason) {
  const int high = hex_value(line.peek());
  if (high < 0) return line.refuse(reason);
  ++line.at;
  const int low = hex_value(line.peek());
  if (low < 0) return line.refuse("a data byte needs two hex digits");
  ++line.at;
  out = static_cast<std::uint8_t>(high * 16 + low);
  return true;
}

}  // namespace pitwall::replay
