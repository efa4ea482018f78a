// Hashes of the registry, by which two ends compare theirs.
//   invariants
//          a hash is the 64-bit FNV-1a of the canonical text (schema_text.hpp). It detects
//          accidental differences; the key exchange that carries it protects against forgery
//   out    one hash for each group; one for the content that must agree before the car may be armed
//          (the safety groups of both directions and the commands); one for everything
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "protocol/telemetry/command/command_table.hpp"
#include "protocol/telemetry/registry/schema_text.hpp"

namespace pitwall::telemetry {

class SchemaHash {
 public:
  constexpr void operator()(std::string_view text) {
    for (const char c : text) value_ = (value_ ^ static_cast<std::uint8_t>(c)) * 0x100000001B3U;
  }
  constexpr std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xCBF29CE484222325U;
};

// command NAME UNIT MIN MAX RESOLUTION TIME_TO_LIVE_MS yes|no[ LABELS]; a space in the name is "_";
// yes: only the holder of the authority may send it.
template <class Sink>
constexpr void write_command(const CommandRow& row, Sink&& write) {
  write("command ");
  for (std::size_t i = 0; i < row.name.size(); ++i)
    write(row.name[i] == ' ' ? std::string_view{"_"} : row.name.substr(i, 1));
  write(" ");
  write(row.unit.empty() ? std::string_view{"-"} : row.unit), write(" ");
  write_range(row.min, row.max, row.resolution, write);
  write(" "), write(Decimal{static_cast<double>(row.time_to_live.ns) / 1e6}.text());
  write(row.needs_authority ? " yes" : " no");
  if (!row.labels.empty()) write(" "), write(row.labels);
  write("\n");
}

// Text that must agree before the car may be armed.
template <class Sink>
constexpr void write_safety(Sink&& write) {
  for (const GroupRow& row : kGroupTable)
    if (row.priority == Class::kSafety) write_group(row.group, write);
  for (const CommandRow& row : kCommandTable) write_command(row, write);
}
template <class Sink>
constexpr void write_schema(Sink&& write) {
  for (const GroupRow& row : kGroupTable) write_group(row.group, write);
  for (const CommandRow& row : kCommandTable) write_command(row, write);
}

inline constexpr auto kGroupHashes = [] {
  std::array<std::uint64_t, kGroups> hashes{};
  for (const GroupRow& row : kGroupTable) {
    SchemaHash hash;
    write_group(row.group, hash);
    hashes[index_of(row.group)] = hash.value();
  }
  return hashes;
}();
constexpr std::uint64_t group_hash(Group group) { return kGroupHashes[index_of(group)]; }

inline constexpr std::uint64_t kSafetyHash = [] {
  SchemaHash hash;
  write_safety(hash);
  return hash.value();
}();
inline constexpr std::uint64_t kSchemaHash = [] {
  SchemaHash hash;
  write_schema(hash);
  return hash.value();
}();

}  // namespace pitwall::telemetry
