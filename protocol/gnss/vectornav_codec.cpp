// SPDX-License-Identifier: Apache-2.0
#include "protocol/gnss/vectornav_codec.hpp"

#include <array>

#include "protocol/bits/crc.hpp"
#include "protocol/gnss/little_endian.hpp"
#include "protocol/gnss/vectornav_fields.hpp"

namespace pitwall::gnss {
namespace {

constexpr std::uint16_t kExtension = 0x8000;  // another word of fields follows
constexpr std::uint8_t kMoreGroups = 0x80;
constexpr unsigned kWordBits = 16;

constexpr VectorNavGroup group_of(std::size_t i) { return static_cast<VectorNavGroup>(i); }

// How long the fields of a mask are, and which bits are known at all.
struct Measurer {
  std::uint32_t mask = 0;
  std::uint32_t known = 0, skipped = 0;
  std::size_t bytes = 0;

  template <class... Field>
  void operator()(unsigned bit, Kind, const Field&... field) {
    known |= 1U << bit;
    if ((mask >> bit & 1U) != 0) bytes += (sizeof(field) + ...);
  }
  void skip(unsigned bit, std::size_t length) {
    known |= 1U << bit;
    skipped |= 1U << bit;
    if ((mask >> bit & 1U) != 0) bytes += length;
  }
};

Measurer measure(VectorNavGroup group, std::uint32_t mask) {
  static constexpr VectorNavMessage kAny{};
  Measurer measurer{.mask = mask};
  visit_fields(group, kAny, measurer);
  return measurer;
}

struct PayloadReader {
  ByteReader in;
  std::uint32_t mask = 0;
  FieldCheck check;

  template <class... Field>
  void operator()(unsigned bit, Kind kind, Field&... field) {
    if ((mask >> bit & 1U) != 0) (read(kind, field), ...);
  }
  void skip(unsigned bit, std::size_t length) {
    if ((mask >> bit & 1U) == 0) return;
    for (std::size_t i = 0; i < length; ++i) in.get<std::uint8_t>();
  }

 private:
  template <class T>
  void read(Kind kind, T& value) {
    value = in.get<T>();
    if (!in.ok()) return check.refuse(DecodeError::kTooShort);
    check.add(kind, value);
  }
  template <class T, std::size_t N>
  void read(Kind kind, std::array<T, N>& values) {
    for (T& value : values) read(kind, value);
  }
};

struct PayloadWriter {
  ByteWriter& out;
  std::uint32_t mask = 0;

  template <class... Field>
  void operator()(unsigned bit, Kind, const Field&... field) {
    if ((mask >> bit & 1U) != 0) (write(field), ...);
  }
  void skip(unsigned bit, std::size_t) { CHECK((mask >> bit & 1U) == 0); }

 private:
  template <class T>
  void write(T value) {
    out.put(value);
  }
  template <class T, std::size_t N>
  void write(const std::array<T, N>& values) {
    for (const T value : values) out.put(value);
  }
};

void write_header(const VectorNavOutput& output, ByteWriter& out) {
  std::uint8_t groups = 0;
  for (std::size_t i = 0; i < kVectorNavGroups; ++i) {
    if (output.fields[i] != 0) groups = static_cast<std::uint8_t>(groups | 1U << i);
  }
  CHECK(groups != 0);
  out.put(kVectorNavSync), out.put(groups);
  for (const std::uint32_t mask : output.fields) {
    if (mask == 0) continue;
    const auto low = static_cast<std::uint16_t>(mask),
               high = static_cast<std::uint16_t>(mask >> 16);
    out.put(static_cast<std::uint16_t>(high != 0 ? low | kExtension : low));
    if (high != 0) out.put(high);
  }
}

}  // namespace

std::optional<VectorNavHeader> read_vectornav_header(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 2) return VectorNavHeader{};
  const std::uint8_t groups = bytes[1];
  if (groups == 0 || (groups & kMoreGroups) != 0) return std::nullopt;
  VectorNavHeader h;
  h.header_bytes = 2;
  for (std::size_t i = 0; i < kVectorNavGroups; ++i) {
    if ((groups >> i & 1U) == 0) continue;
    std::uint32_t mask = 0;
    bool more = true;
    for (unsigned shift = 0; more; shift += kWordBits, h.header_bytes += 2) {
      if (shift > kWordBits) return std::nullopt;  // a third word
      if (bytes.size() < h.header_bytes + 2) return VectorNavHeader{};
      const auto word = ByteReader{bytes.subspan(h.header_bytes)}.get<std::uint16_t>();
      more = (word & kExtension) != 0;
      mask |= (word & ~std::uint32_t{kExtension}) << shift;
    }
    const Measurer measured = measure(group_of(i), mask);
    if (mask == 0 || (mask & ~measured.known) != 0) return std::nullopt;
    h.output.fields[i] = mask;
    h.payload_bytes += measured.bytes;
  }
  return h;
}

Result<VectorNavMessage, DecodeError> decode(const VectorNavFrame& frame) {
  VectorNavMessage message;
  message.output = frame.output;
  PayloadReader reader{ByteReader{frame.payload}, 0, {}};
  for (std::size_t i = 0; i < kVectorNavGroups; ++i) {
    reader.mask = frame.output.fields[i];
    visit_fields(group_of(i), message, reader);
  }
  if (reader.check.refusal()) return Unexpected{*reader.check.refusal()};
  return message;
}

std::size_t encode(const VectorNavMessage& message, std::span<std::uint8_t> out) {
  ByteWriter writer{out};
  write_header(message.output, writer);
  PayloadWriter payload{writer};
  for (std::size_t i = 0; i < kVectorNavGroups; ++i) {
    payload.mask = message.output.fields[i];
    visit_fields(group_of(i), message, payload);
  }
  const std::uint16_t crc =
      bits::crc16_ccitt_false(out.subspan(1, writer.size() - 1), 0);  // without the sync
  writer.put(static_cast<std::uint8_t>(crc >> 8U));
  writer.put(static_cast<std::uint8_t>(crc & 0xFFU));
  return writer.size();
}

std::uint32_t writable_fields(VectorNavGroup group) {
  const Measurer all = measure(group, 0);
  return all.known & ~all.skipped;
}

}  // namespace pitwall::gnss
