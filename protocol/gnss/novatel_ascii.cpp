// SPDX-License-Identifier: Apache-2.0
#include "protocol/gnss/novatel_ascii.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <type_traits>

#include "protocol/bits/crc.hpp"
#include "protocol/gnss/novatel_fields.hpp"
#include "protocol/gnss/novatel_names.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::gnss {
namespace {

constexpr std::uint8_t kResponse = 0x80;
constexpr int kHexBase = 16;

// The fields between commas; a comma between quotes separates nothing.
class Fields {
 public:
  explicit Fields(std::string_view text) : rest_(text) {}

  std::optional<std::string_view> next() {
    if (over_) return std::nullopt;
    bool quoted = false;
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      if (rest_[i] == '"') quoted = !quoted;
      if (rest_[i] == ',' && !quoted) {
        const std::string_view field = rest_.substr(0, i);
        rest_.remove_prefix(i + 1);
        return field;
      }
    }
    over_ = true;
    return rest_;
  }
  bool over() const { return over_; }

 private:
  std::string_view rest_;
  bool over_ = false;
};

template <class T>
bool read_whole(std::string_view text, T& value, int base) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value, base);
  return error == std::errc{} && stop == end;
}

template <class T>
bool read_number(std::string_view text, T& value) {
  if constexpr (std::is_floating_point_v<T>) {
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    return error == std::errc{} && stop == end;
  } else {
    return read_whole(text, value, 10);
  }
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool read_letter(std::string_view text, std::uint32_t& value) {
  if (text.size() != 1 || is_digit(text[0])) return read_number(text, value);
  value = static_cast<unsigned char>(text[0]);
  return true;
}

template <class T>
bool read_value(Kind kind, std::string_view text, T& value) {
  if constexpr (std::is_unsigned_v<T>) {
    if (kind == Kind::kHex) return read_whole(text, value, kHexBase);
  }
  if constexpr (std::is_same_v<T, std::uint32_t>) {
    if (kind == Kind::kLetter) return read_letter(text, value);
    if (const auto named = value_of(kind, text)) {
      value = *named;
      return true;
    }
  }
  return read_number(text, value);
}

bool read_text(std::string_view text, std::array<char, 4>& value) {
  if (text.size() < 2 || text.front() != '"' || text.back() != '"') return false;
  text = text.substr(1, text.size() - 2);
  if (text.size() > value.size() || text.find('"') != std::string_view::npos) return false;
  value = {};
  std::copy(text.begin(), text.end(), value.begin());
  return true;
}

struct TextReader {
  Fields fields;
  FieldCheck check;

  template <class... Field>
  void operator()(Kind kind, Field&... field) {
    (read(kind, field), ...);
  }

 private:
  template <class T>
  void read(Kind kind, T& value) {
    const auto text = fields.next();
    if (!text) return check.refuse(DecodeError::kTooShort);
    if (!parse(kind, *text, value)) return check.refuse(DecodeError::kBadText);
    check.add(kind, value);
  }
  static bool parse(Kind, std::string_view text, std::array<char, 4>& value) {
    return read_text(text, value);
  }
  template <class T>
  static bool parse(Kind kind, std::string_view text, T& value) {
    return read_value(kind, text, value);
  }
};

// Milliseconds of the week from seconds.
bool read_milliseconds(std::string_view text, std::uint32_t& milliseconds) {
  double seconds = 0.0;
  if (!read_number(text, seconds) || check_field(Kind::kSeconds, seconds)) return false;
  milliseconds = static_cast<std::uint32_t>(std::llround(seconds * 1e3));
  return true;
}

bool read_time_status(std::string_view text, std::uint8_t& status) {
  const auto named = time_status_value(text);
  if (named) status = *named;
  return named || read_number(text, status);
}

bool read_idle(std::string_view text, std::uint8_t& idle_time) {
  double percent = 0.0;
  if (!read_number(text, percent) || !(percent >= 0.0 && percent <= 100.0)) return false;
  idle_time = static_cast<std::uint8_t>(std::lround(percent * 2.0));
  return true;
}

// Takes the format letter off: A is a log, R a response.
bool read_name(std::string_view text, NovatelHeader& h) {
  if (text.size() < 2 || (text.back() != 'A' && text.back() != 'R')) return false;
  if (text.back() == 'R') h.message_type = kResponse;
  text.remove_suffix(1);
  h.id = log_id(text).value_or(0);
  return true;
}

class TextWriter {
 public:
  explicit TextWriter(std::span<std::uint8_t> out) : out_(out) {}

  void put(char c) {
    CHECK(size_ < out_.size());
    out_[size_++] = static_cast<std::uint8_t>(c);
  }
  void put(std::string_view text) {
    for (const char c : text) put(c);
  }
  template <class T>
  void number(T value) {
    std::array<char, 32> digits{};  // a double takes 24
    const auto [end, error] = std::to_chars(digits.begin(), digits.end(), value);
    CHECK(error == std::errc{});
    put(std::string_view{digits.data(), static_cast<std::size_t>(end - digits.data())});
  }
  void hex(std::uint32_t value, std::size_t digits) {
    for (std::size_t k = digits; k-- > 0;) put("0123456789abcdef"[(value >> (4 * k)) & 0xFU]);
  }
  std::span<const std::uint8_t> written() const { return out_.first(size_); }

 private:
  std::span<std::uint8_t> out_;
  std::size_t size_ = 0;
};

struct TextFieldWriter {
  TextWriter& out;
  bool first = true;

  template <class... Field>
  void operator()(Kind kind, const Field&... field) {
    (write(kind, field), ...);
  }

 private:
  template <class T>
  void write(Kind kind, const T& value) {
    if (!first) out.put(',');
    first = false;
    put(kind, value);
  }
  void put(Kind, const std::array<char, 4>& text) {
    out.put('"');
    for (const char c : text) {
      if (c == '\0') break;
      CHECK(c >= ' ' && c <= '~' && c != '"');
      out.put(c);
    }
    out.put('"');
  }
  void put(Kind kind, std::uint32_t value) {
    const std::string_view name = name_of(kind, value);
    if (kind == Kind::kHex) return out.hex(value, 2 * sizeof value);
    if (!name.empty()) return out.put(name);
    const bool letter = kind == Kind::kLetter && value > ' ' && value <= '~' && value != ',' &&
                        value != '"' && value != ';' && !is_digit(static_cast<char>(value));
    if (letter) return out.put(static_cast<char>(value));
    out.number(value);
  }
  void put(Kind kind, std::uint8_t value) {
    if (kind == Kind::kHex) return out.hex(value, 2 * sizeof value);
    out.number(value);
  }
  template <class T>
  void put(Kind, T value) {
    out.number(value);
  }
};

void write_seconds(TextWriter& out, std::uint32_t milliseconds) {
  out.number(milliseconds / 1'000);
  out.put('.');
  const std::uint32_t rest = milliseconds % 1'000;
  for (const std::uint32_t unit : {100U, 10U, 1U}) out.number(rest / unit % 10);
}

void write_port(TextWriter& out, std::uint8_t port) {
  const auto name = port_name(port);
  if (!name) return out.put("UNKNOWN");
  out.put(name->name);
  if (name->virtual_port == 0) return;
  out.put('_');
  out.number(name->virtual_port);
}

void write_header(TextWriter& out, const NovatelHeader& h) {
  out.put(h.short_form ? kAsciiShort : kAsciiLong);
  out.put(log_name(h.id));
  out.put("A,");
  if (!h.short_form) {
    write_port(out, h.port), out.put(',');
    out.number(h.sequence), out.put(',');
    out.number(h.idle_time / 2), out.put(h.idle_time % 2 == 0 ? ".0," : ".5,");
    const std::string_view status = time_status_name(h.time_status);
    if (status.empty()) {
      out.number(h.time_status);
    } else {
      out.put(status);
    }
    out.put(',');
  }
  out.number(h.week), out.put(',');
  write_seconds(out, h.milliseconds);
  if (!h.short_form) {
    out.put(','), out.hex(h.receiver_status, 8), out.put(',');
    out.hex(h.reserved, 4), out.put(',');
    out.number(h.receiver_version);
  }
  out.put(';');
}

}  // namespace

std::optional<NovatelHeader> read_ascii_header(std::string_view text, bool short_form) {
  Fields fields{text};
  NovatelHeader h;
  h.short_form = short_form;
  bool good = read_name(fields.next().value_or(""), h);
  const auto next = [&fields] { return fields.next().value_or(""); };
  if (short_form) {
    h.port = 0;
    h.time_status = 0;  // a short header does not say
  } else {
    h.port = port_value(next()).value_or(0);
    good = good && read_number(next(), h.sequence) && read_idle(next(), h.idle_time) &&
           read_time_status(next(), h.time_status);
  }
  good = good && read_number(next(), h.week) && read_milliseconds(next(), h.milliseconds);
  if (!short_form) {
    good = good && read_whole(next(), h.receiver_status, kHexBase) &&
           read_whole(next(), h.reserved, kHexBase) && read_number(next(), h.receiver_version);
  }
  if (!good || !fields.over()) return std::nullopt;
  return h;
}

Result<NovatelMessage, DecodeError> decode_ascii(std::uint16_t id, std::string_view fields) {
  auto message = message_of(id);
  if (!message) return Unexpected{DecodeError::kUnknownId};
  TextReader reader{Fields{fields}, {}};
  std::visit([&reader](auto& m) { visit_fields(m, reader); }, *message);
  if (reader.check.refusal()) return Unexpected{*reader.check.refusal()};
  return *message;
}

std::size_t encode_ascii(NovatelHeader header, const NovatelMessage& message,
                         std::span<std::uint8_t> out) {
  TextWriter text{out};
  std::visit(
      [&](const auto& m) {
        header.id = m.kId;
        header.short_form = m.kShort;
        write_header(text, header);
        TextFieldWriter writer{text};
        visit_fields(m, writer);
      },
      message);
  const std::uint32_t crc = bits::crc32_novatel(text.written().subspan(1));  // without the sync
  text.put('*');
  text.hex(crc, 8);
  text.put("\r\n");
  return text.written().size();
}

}  // namespace pitwall::gnss
