// SPDX-License-Identifier: Apache-2.0
#include "protocol/json/json_text.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::json {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

struct Lead {
  std::uint8_t from, to;     // of the first byte
  std::uint8_t second_from;  // of the second one; the others are 0x80 to 0xBF
  std::uint8_t second_to;
  std::size_t bytes;
};
constexpr std::array<Lead, 8> kLeads{{{0xC2, 0xDF, 0x80, 0xBF, 2},
                                      {0xE0, 0xE0, 0xA0, 0xBF, 3},
                                      {0xE1, 0xEC, 0x80, 0xBF, 3},
                                      {0xED, 0xED, 0x80, 0x9F, 3},
                                      {0xEE, 0xEF, 0x80, 0xBF, 3},
                                      {0xF0, 0xF0, 0x90, 0xBF, 4},
                                      {0xF1, 0xF3, 0x80, 0xBF, 4},
                                      {0xF4, 0xF4, 0x80, 0x8F, 4}}};

constexpr bool within(char c, std::uint8_t from, std::uint8_t to) {
  return static_cast<std::uint8_t>(c) >= from && static_cast<std::uint8_t>(c) <= to;
}

// Bytes of the character beyond ASCII that the text begins with; 0: it is none.
std::size_t character(std::string_view text) {
  for (const Lead& lead : kLeads) {
    if (!within(text[0], lead.from, lead.to)) continue;
    if (text.size() < lead.bytes || !within(text[1], lead.second_from, lead.second_to)) return 0;
    for (std::size_t i = 2; i < lead.bytes; ++i) {
      if (!within(text[i], 0x80, 0xBF)) return 0;
    }
    return lead.bytes;
  }
  return 0;
}

void escape(std::string& out, char c) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  const auto code = static_cast<unsigned char>(c);
  out += "\\u00";
  out += kDigits[code >> 4U];
  out += kDigits[code & 15U];
}

}  // namespace

std::string quoted(std::string_view text) {
  std::string out = "\"";
  while (!text.empty()) {
    const char c = text[0];
    std::size_t bytes = 1;
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (within(c, 0x00, 0x1F) || c == 0x7F) {
      escape(out, c);
    } else if (within(c, 0x20, 0x7E)) {
      out += c;
    } else if (const std::size_t wide = character(text); wide > 0) {
      out += text.substr(0, wide);
      bytes = wide;
    } else {
      out += kReplacement;
    }
    text.remove_prefix(bytes);
  }
  return out + '"';
}

std::string number(double value) { return std::isfinite(value) ? shortest(value) : "null"; }

std::string integer(std::int64_t value) { return std::to_string(value); }

Object& Object::json(std::string_view name, std::string_view value) {
  if (!text_.empty()) text_ += ", ";
  text_ += quoted(name);
  text_ += ": ";
  text_ += value;
  return *this;
}

Array& Array::json(std::string_view value) {
  if (!text_.empty()) text_ += ", ";
  text_ += value;
  return *this;
}

}  // namespace pitwall::json
