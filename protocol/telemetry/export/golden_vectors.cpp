// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/export/golden_vectors.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "protocol/telemetry/packet/group_codec.hpp"
#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {
namespace {

using Code = std::optional<std::uint64_t>;

Code first(FieldIndex) { return 0; }
Code last(FieldIndex i) { return kFields[i].quantized().count() - 1; }
Code unset(FieldIndex) { return std::nullopt; }
Code mixed(FieldIndex i) {
  constexpr std::uint64_t kSpread = 2'654'435'761U;  // Knuth's multiplicative hash
  if (i % 7 == 3) return std::nullopt;
  return (i + 1) * kSpread % kFields[i].quantized().count();
}

std::string hex_of(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 15U];
  }
  return text;
}

template <class Choice>
std::string vector_of(Group group, std::string_view name, Choice&& choice) {
  std::string line = std::string{row_of(group).name} + " " + std::string{name};
  Values values;
  const auto [begin, count] = fields_of(group);
  for (FieldIndex i = begin; i < begin + count; ++i) {
    const Code code = choice(i);
    line += " " + std::string{kFields[i].name} + "=" + (code ? std::to_string(*code) : "-");
    if (code) values[i] = kFields[i].quantized().decode(*code);
  }
  std::array<std::uint8_t, 256> buffer{};
  bits::BitWriter out{buffer};
  CodecCounters counters;
  CHECK(encode_group(group, values, out, counters) && out.align());
  CHECK(counters.saturated == 0 && counters.not_finite == 0);
  return line + " " + hex_of(std::span{buffer}.first(out.bytes())) + "\n";
}

}  // namespace

std::string golden_vectors() {
  std::string text;
  for (const GroupRow& row : kGroupTable) {
    text += vector_of(row.group, "first", first);
    text += vector_of(row.group, "last", last);
    text += vector_of(row.group, "unset", unset);
    text += vector_of(row.group, "mixed", mixed);
  }
  return text;
}

}  // namespace pitwall::telemetry
