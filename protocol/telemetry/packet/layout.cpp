// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/packet/layout.hpp"

#include <array>

namespace pitwall::telemetry {

namespace {

constexpr Layout layout_of(Direction direction) {
  Layout layout;
  for (const GroupRow& row : kGroupTable) {
    if (row.direction != direction) continue;
    const auto bits = static_cast<std::uint16_t>(group_bits(row.group));
    CHECK(layout.push({row.group, bits}));
  }
  return layout;
}
constexpr std::array kOwn{layout_of(Direction::kDown), layout_of(Direction::kUp)};

}  // namespace

const Layout& own_layout(Direction direction) { return kOwn[static_cast<std::size_t>(direction)]; }

}  // namespace pitwall::telemetry
