// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/parser/dbc_encoding.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "protocol/can/parser/dbc_statement.hpp"

namespace pitwall::can {
namespace {

using namespace std::string_view_literals;

struct Signature {
  std::string_view front, kind;
};
constexpr std::array<Signature, 18> kSignatures{
    {{"\x1F\x8B"sv, "a gzip file"},
     {"PK\x03\x04"sv, "a zip archive or an Excel sheet"},
     {"\x7F"
      "ELF"sv,
      "a program"},
     {"LOGG"sv, "a Vector BLF log"},
     {"MDF     "sv, "an ASAM MDF recording"},
     {"\x89MCAP"sv, "an MCAP recording"},
     {"\xED\xA1\xDA\x01"sv, "an LCM event log"},
     {"SQLite format 3"sv, "a SQLite database"},
     {"\xD4\xC3\xB2\xA1"sv, "a pcap capture"},
     {"\xA1\xB2\xC3\xD4"sv, "a pcap capture"},
     {"\x0A\x0D\x0D\x0A"sv, "a pcapng capture"},
     {"%PDF"sv, "a PDF document"},
     {"\xFF\xFE\0\0"sv, "a text in UTF-32"},
     {"\0\0\xFE\xFF"sv, "a text in UTF-32"},
     {";$FILEVERSION"sv, "a PEAK TRC log"},
     {"FormatVersion="sv, "a PEAK symbol file"},
     {"[DATABASE_VERSION]"sv, "a BUSMASTER database"},
     {"<"sv, "an XML file such as ARXML or KCD"}}};

// Of a line: "(1436509052.249713) can0 123#11".
bool is_candump_line(std::string_view line) {
  if (!line.starts_with('(')) return false;
  const std::size_t end = line.find_first_not_of("0123456789.", 1);
  return end != std::string_view::npos && end > 1 && line[end] == ')';
}

// Control characters that no text holds.
bool is_binary(std::string_view bytes) {
  return std::any_of(bytes.begin(), bytes.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && "\t\r\n\f\v\x1A"sv.find(c) == ""sv.npos;
  });
}

bool has_section(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    at = std::min(text.find_first_not_of(" \t\r\n", at), text.size());
    if (is_section(first_word(text.substr(at)))) return true;
    at = std::min(text.find_first_of("\r\n", at), text.size());
  }
  return false;
}

void append_utf8(std::string& out, std::uint32_t point) {
  const auto put = [&](std::uint32_t byte) { out += static_cast<char>(byte); };
  if (point < 0x80) return put(point);
  if (point < 0x800) {
    put(0xC0U | point >> 6U);
  } else if (point < 0x10000) {
    put(0xE0U | point >> 12U);
    put(0x80U | (point >> 6U & 0x3FU));
  } else {
    put(0xF0U | point >> 18U);
    put(0x80U | (point >> 12U & 0x3FU));
    put(0x80U | (point >> 6U & 0x3FU));
  }
  put(0x80U | (point & 0x3FU));
}

constexpr bool is_high_surrogate(std::uint32_t unit) { return unit >= 0xD800 && unit < 0xDC00; }
constexpr bool is_low_surrogate(std::uint32_t unit) { return unit >= 0xDC00 && unit < 0xE000; }
constexpr std::uint32_t kReplacement = 0xFFFD;

}  // namespace

std::optional<Utf16Text> from_utf16(std::string_view bytes) {
  Utf16Text out;
  out.is_little_endian = bytes.starts_with("\xFF\xFE"sv);
  if (!out.is_little_endian && !bytes.starts_with("\xFE\xFF"sv)) return std::nullopt;
  if (bytes.starts_with("\xFF\xFE\0\0"sv)) return std::nullopt;  // UTF-32
  const auto unit = [&](std::size_t at) -> std::uint32_t {
    const auto a = static_cast<unsigned char>(bytes[at]);
    const auto b = static_cast<unsigned char>(bytes[at + 1]);
    return out.is_little_endian ? a | static_cast<unsigned>(b) << 8U
                                : b | static_cast<unsigned>(a) << 8U;
  };
  const auto broken = [&] {
    if (out.broken++ == 0) out.first_broken_at = out.utf8.size();
    append_utf8(out.utf8, kReplacement);
  };
  std::size_t at = 2;
  for (; at + 1 < bytes.size(); at += 2) {
    const std::uint32_t first = unit(at);
    if (is_high_surrogate(first) && at + 3 < bytes.size() && is_low_surrogate(unit(at + 2))) {
      append_utf8(out.utf8, 0x10000 + ((first - 0xD800) << 10U) + (unit(at + 2) - 0xDC00));
      at += 2;
    } else if (is_high_surrogate(first) || is_low_surrogate(first)) {
      broken();
    } else {
      append_utf8(out.utf8, first);
    }
  }
  if (at < bytes.size()) broken();
  return out;
}

std::string_view kind_of_file(std::string_view bytes) {
  for (const Signature& s : kSignatures) {
    if (bytes.starts_with(s.front)) return s.kind;
  }
  if (bytes.starts_with("\xEF\xBB\xBF"sv)) bytes.remove_prefix(3);
  const std::size_t front = bytes.find_first_not_of(" \t\r\n\f\v");
  if (front == std::string_view::npos) return "an empty file";
  if (has_section(bytes)) return "";
  if (is_binary(bytes)) {
    const bool is_wide = bytes.size() > 2 && (bytes[0] == '\0') != (bytes[1] == '\0');
    return is_wide ? "a text in UTF-16 without a byte order mark" : "binary data";
  }
  const std::string_view text = bytes.substr(front);
  if (is_candump_line(text)) return "a candump log";
  if (text.starts_with("date ")) return "a Vector ASC log";
  return text.starts_with('{') || text.starts_with('[') ? "a JSON file" : "a plain text";
}

}  // namespace pitwall::can
