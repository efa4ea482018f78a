// Snapshot of one end's own state: the value of each field and the sample time of each group. A
// packet is made from the newest snapshot at the moment of sending.
//   units  Instant on the clock of the end that made the snapshot
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>

#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

inline constexpr Instant kNeverSampled{std::numeric_limits<std::int64_t>::min()};

struct Snapshot {
  Values values;
  std::array<Instant, kGroups> sampled_at = [] {
    std::array<Instant, kGroups> never{};
    never.fill(kNeverSampled);
    return never;
  }();

  constexpr Instant& at(Group g) { return sampled_at[index_of(g)]; }
  constexpr Instant at(Group g) const { return sampled_at[index_of(g)]; }
  constexpr bool ever(Group g) const { return at(g) != kNeverSampled; }
};

}  // namespace pitwall::telemetry
