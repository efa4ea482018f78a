// Reference decoder of a packet body, written from the description in body.hpp alone: a string of
// bits, no shared code, not optimised. Tests and fuzzers compare with it.
//   in     any bytes
//   out    nullopt if they are not a body, otherwise its content; values in units of their fields
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "protocol/telemetry/registry/registry.hpp"

namespace pitwall::testing {

struct ReferenceBody {
  std::uint64_t time = 0, paths = 0;
  bool has_ack = false;
  std::uint64_t newest = 0, mask = 0, hold = 0;
  std::map<telemetry::Group, std::uint64_t> ages;
  std::map<std::size_t, double> values;  // by field; NaN: unset
  std::vector<std::pair<std::uint64_t, std::string>> records;
};

// Reader of the bits of a packet; below(n) reads n bytes as little endian, top(n) n bits in order.
struct ReferenceBits {
  const std::vector<std::uint8_t>& bytes;
  std::size_t at = 0;
  bool ok = true;

  bool more() const { return ok && at < 8 * bytes.size(); }
  std::uint64_t top(std::size_t count) {
    if (count > 8 * bytes.size() - at) return ok = false, 0;
    std::uint64_t value = 0;
    for (; count > 0; --count, ++at) value = 2 * value + (bytes[at / 8] >> (7 - at % 8)) % 2U;
    return value;
  }
  std::uint64_t below(std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) value += top(8) * (std::uint64_t{1} << (8 * i));
    return value;
  }
};

struct ReferenceField {
  double last = 0;          // largest step
  std::uint64_t unset = 1;  // pattern of an unset value: all ones
  std::size_t width = 1;
};
inline const std::vector<ReferenceField>& reference_fields() {
  static const auto fields = [] {
    std::vector<ReferenceField> all;
    for (const telemetry::FieldRow& row : telemetry::kFields) {
      ReferenceField field{std::floor((row.max - row.min) / row.resolution + 0.5)};
      while (static_cast<double>(field.unset) < field.last + 1) {
        field.unset = 2 * field.unset + 1;
        ++field.width;
      }
      all.push_back(field);
    }
    return all;
  }();
  return fields;
}

inline bool read_reference_groups(ReferenceBits& rest, telemetry::Direction direction,
                                  ReferenceBody& body) {
  std::vector<telemetry::Group> all;
  for (const auto& row : telemetry::kGroupTable)
    if (row.direction == direction) all.push_back(row.group);
  const std::uint64_t set = rest.below((all.size() + 7) / 8);
  if (set == 0 || set >= std::uint64_t{1} << all.size()) return false;
  std::size_t used = 0;
  for (std::size_t k = 0; k < all.size(); ++k)
    if ((set >> k) % 2 == 1) body.ages[all[k]] = rest.top(4), used += 4;
  for (std::size_t i = 0; i < telemetry::kFieldCount; ++i) {
    const telemetry::FieldRow& row = telemetry::kFields[i];
    if (!body.ages.contains(row.group)) continue;
    const ReferenceField& field = reference_fields()[i];
    const std::uint64_t step = rest.top(field.width);
    used += field.width;
    const auto steps = static_cast<double>(step);
    if (steps > field.last && step != field.unset) return false;
    body.values[i] = step == field.unset ? std::nan("") : row.min + steps * row.resolution;
  }
  return rest.top((8 - used % 8) % 8) == 0 && rest.ok;
}

inline std::optional<ReferenceBody> read_reference(const std::vector<std::uint8_t>& bytes,
                                                   telemetry::Direction direction) {
  if (bytes.size() < 4 || bytes.size() > 1'177) return std::nullopt;
  ReferenceBits rest{bytes};
  ReferenceBody body;
  body.time = rest.below(3);
  const std::uint64_t flags = rest.below(1);
  if (flags > 0x0F) return std::nullopt;
  body.paths = flags / 4;
  body.has_ack = flags % 2 == 1;
  if (body.has_ack) {
    body.newest = rest.below(2);
    body.mask = rest.below(4);
    body.hold = rest.below(2);
  }
  if (flags / 2 % 2 == 1 && !read_reference_groups(rest, direction, body)) return std::nullopt;
  while (rest.more()) {
    const std::uint64_t type = rest.below(1);
    std::uint64_t length = rest.below(1);
    if (length >= 0xF0) {
      length = (length - 0xF0) * 256 + rest.below(1);
      if (length < 0xF0) return std::nullopt;
    }
    if (type < 1 || type > 12 || body.records.size() == 48) return std::nullopt;
    std::string payload;
    for (std::uint64_t i = 0; i < length && rest.ok; ++i)
      payload += static_cast<char>(rest.below(1));
    body.records.emplace_back(type, payload);
  }
  if (!rest.ok) return std::nullopt;
  return body;
}

}  // namespace pitwall::testing
