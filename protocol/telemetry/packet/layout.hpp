// Layout of a sender's packets: the groups of its direction in the order of the bits of their set,
// as its registry defines them. Two ends whose registries differ read each other's packets by the
// sender's layout and skip unknown groups.
//   invariants
//          place k is bit k of the set; a place with a group of our registry has that group's size
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"

namespace pitwall::telemetry {

struct GroupPlace {
  std::optional<Group> own;  // empty: our registry does not have the group, or defines it otherwise
  std::uint16_t bits = 0;    // size of its values
};

inline constexpr std::size_t kMaxPlaces = 64;
using Layout = FixedVector<GroupPlace, kMaxPlaces>;

// Size of the set in bytes.
constexpr std::size_t set_size(const Layout& layout) { return (layout.size() + 7) / 8; }

// Layout of our own registry.
const Layout& own_layout(Direction direction);

}  // namespace pitwall::telemetry
