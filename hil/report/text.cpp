// SPDX-License-Identifier: Apache-2.0
#include "hil/report/text.hpp"

#include <array>
#include <cmath>
#include <cstdint>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::report {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 1;
  bool whole = false;
};

// The first character of `text`, which is not empty. Not whole: one byte of something else.
Character first_of(std::string_view text) {
  const auto byte = [&text](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t lead = byte(0);
  if (lead < 0x80) return {lead, 1, true};
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return {};
  std::uint32_t code = lead & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    code = (code << 6U) | (byte(i) & 0x3FU);
  }
  constexpr std::array<std::uint32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < kLeast[length] || code > 0x10FFFF || surrogate) return {};
  return {code, length, true};
}

bool is_presentable(std::uint32_t code) {
  if (code < 0x20 || (code >= 0x7F && code < 0xA0)) return false;  // controls
  if ((code & 0xFFFEU) == 0xFFFEU) return false;                   // no characters
  const bool turns_direction =
      (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
  return !turns_direction;
}

std::string_view entity_of(std::uint32_t code) {
  switch (code) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    case '\t':
    case '\n':
    case '\r':
      return " ";
    default:
      return {};
  }
}

std::string without_sign_of_zero(std::string text) {
  if (text.starts_with('-') && text.find_first_of("123456789") == std::string::npos)
    text.erase(0, 1);
  return text;
}

std::string unusual(double value) {
  if (std::isnan(value)) return "not known";
  return value > 0 ? "unbounded" : "-unbounded";
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size() + text.size() / 8);
  while (!text.empty()) {
    const Character c = first_of(text);
    const std::string_view entity = c.whole ? entity_of(c.code) : std::string_view{};
    if (!entity.empty()) {
      out += entity;
    } else {
      out += c.whole && is_presentable(c.code) ? text.substr(0, c.bytes) : kReplacement;
    }
    text.remove_prefix(c.bytes);
  }
  return out;
}

std::string number(double value, int decimals) {
  if (!std::isfinite(value)) return unusual(value);
  if (std::abs(value) >= 1e15) return significant(value, 6);
  return without_sign_of_zero(formatted("%.*f", decimals, value));
}

std::string significant(double value, int digits) {
  if (!std::isfinite(value)) return unusual(value);
  return without_sign_of_zero(formatted("%.*g", digits, value));
}

}  // namespace pitwall::report
