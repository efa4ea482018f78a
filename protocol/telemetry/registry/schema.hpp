// Compile-time properties of the registry: sizes, shares of the radio, and the hashes by which two
// ends compare their registries.
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
#include "protocol/telemetry/packet/header.hpp"
#include "protocol/telemetry/registry/schema_text.hpp"

namespace pitwall::telemetry {

// ---- Sizes

constexpr std::size_t bits_of(GroupSet set) {
  std::size_t bits = 0;
  for (const GroupRow& row : kGroupTable)
    if (set.has(row.group)) bits += group_bits(row.group);
  return bits;
}
constexpr std::size_t bytes_of(GroupSet set) { return (bits_of(set) + 7) / 8; }

// Size on the wire: the set, one age code of four bits for each group, the values.
constexpr std::size_t state_bytes(GroupSet set, Direction direction) {
  const std::size_t codes = 4 * set.count() + bits_of(set);
  return (groups_of(direction).count() + 7) / 8 + (codes + 7) / 8;
}

inline constexpr std::size_t kSafetyShare = 40;  // bytes of every packet, each way
static_assert(bytes_of(groups_of(Direction::kDown, Class::kSafety)) <= kSafetyShare,
              "the safety groups of the car take more than their share of every packet");
static_assert(bytes_of(groups_of(Direction::kUp, Class::kSafety)) <= kSafetyShare,
              "the safety groups of the base take more than their share of every packet");
// Fixed part and acknowledgement of a body, as defined in packet/body.hpp.
inline constexpr std::size_t kBodyOverhead = 4 + 8;
static_assert(kBodyOverhead + state_bytes(groups_of(Direction::kDown), Direction::kDown) <=
                  kMaxBody,
              "everything that the car tells must fit into one datagram");
static_assert(groups_of(Direction::kDown).count() + groups_of(Direction::kUp).count() == kGroups);

// ---- Hashes

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
