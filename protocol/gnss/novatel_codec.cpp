// SPDX-License-Identifier: Apache-2.0
#include "protocol/gnss/novatel_codec.hpp"

#include <array>
#include <string_view>

#include "protocol/bits/crc.hpp"
#include "protocol/gnss/little_endian.hpp"
#include "protocol/gnss/novatel_ascii.hpp"
#include "protocol/gnss/novatel_fields.hpp"

namespace pitwall::gnss {
namespace {

constexpr std::uint8_t kResponseBit = 0x80, kFormatBits = 0x60;

struct FieldReader {
  ByteReader in;
  FieldCheck check;

  template <class... Field>
  void operator()(Kind kind, Field&... field) {
    (read(kind, field), ...);
  }

 private:
  template <class T>
  void read(Kind kind, T& field) {
    field = in.get<T>();
    if (!in.ok()) return check.refuse(DecodeError::kTooShort);
    check.add(kind, field);
  }
  void read(Kind, std::array<char, 4>& text) {
    for (char& c : text) c = static_cast<char>(in.get<std::uint8_t>());
    if (!in.ok()) check.refuse(DecodeError::kTooShort);
  }
};

struct FieldWriter {
  ByteWriter out;

  template <class... Field>
  void operator()(Kind, const Field&... field) {
    (write(field), ...);
  }

 private:
  template <class T>
  void write(T field) {
    out.put(field);
  }
  void write(const std::array<char, 4>& text) {
    for (const char c : text) out.put(static_cast<std::uint8_t>(c));
  }
};

Result<NovatelMessage, DecodeError> decode_binary(const NovatelFrame& frame) {
  auto message = message_of(frame.header.id);
  if (!message) return Unexpected{DecodeError::kUnknownId};
  FieldReader reader{ByteReader{frame.body}, {}};
  std::visit([&reader](auto& m) { visit_fields(m, reader); }, *message);
  if (reader.check.refusal()) return Unexpected{*reader.check.refusal()};
  return *message;
}

}  // namespace

Result<NovatelMessage, DecodeError> decode(const NovatelFrame& frame) {
  if ((frame.header.message_type & kResponseBit) != 0) return Unexpected{DecodeError::kResponse};
  if (frame.ascii) {
    const auto* text = reinterpret_cast<const char*>(frame.body.data());
    return decode_ascii(frame.header.id, std::string_view{text, frame.body.size()});
  }
  if ((frame.header.message_type & kFormatBits) != 0) return Unexpected{DecodeError::kNotBinary};
  return decode_binary(frame);
}

std::size_t encode_header(const NovatelHeader& h, std::uint16_t body_bytes,
                          std::span<std::uint8_t> out) {
  ByteWriter w{out};
  w.put<std::uint8_t>(0xAA), w.put<std::uint8_t>(0x44);
  if (h.short_form) {
    w.put<std::uint8_t>(0x13);
    CHECK(body_bytes <= 0xFF);
    w.put(static_cast<std::uint8_t>(body_bytes));
    w.put(h.id), w.put(h.week), w.put(h.milliseconds);
    return w.size();
  }
  w.put<std::uint8_t>(0x12), w.put(static_cast<std::uint8_t>(kLongHeaderBytes));
  w.put(h.id), w.put(h.message_type), w.put(h.port);
  w.put(body_bytes), w.put(h.sequence), w.put(h.idle_time), w.put(h.time_status);
  w.put(h.week), w.put(h.milliseconds), w.put(h.receiver_status);
  w.put(h.reserved), w.put(h.receiver_version);
  return w.size();
}

std::size_t encode(NovatelHeader header, const NovatelMessage& message,
                   std::span<std::uint8_t> out) {
  return std::visit(
      [&](const auto& m) {
        using Message = std::remove_cvref_t<decltype(m)>;
        header.id = Message::kId;
        header.short_form = Message::kShort;
        const std::size_t at = Message::kShort ? kShortHeaderBytes : kLongHeaderBytes;
        FieldWriter body{ByteWriter{out.subspan(at)}};
        visit_fields(m, body);
        CHECK(body.out.size() <= Message::kBytes);
        encode_header(header, static_cast<std::uint16_t>(body.out.size()), out);
        const std::size_t covered = at + body.out.size();
        ByteWriter crc{out.subspan(covered)};
        crc.put(bits::crc32_novatel(out.first(covered)));
        return covered + crc.size();
      },
      message);
}

}  // namespace pitwall::gnss
