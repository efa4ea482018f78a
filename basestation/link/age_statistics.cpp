// SPDX-License-Identifier: Apache-2.0
#include "basestation/link/age_statistics.hpp"

namespace pitwall::link {

void AgeStatistics::advance(Instant now) {
  const Duration length = now - counted_to_;
  if (length.ns <= 0) return;
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    const std::size_t g = telemetry::index_of(row.group);
    if (sampled_[g] == telemetry::kNeverSampled) continue;
    const Duration age = counted_to_ - sampled_[g];
    classes_[static_cast<std::size_t>(row.priority)].add(age, length);
    groups_[g].add(age, length);
  }
  counted_to_ = now;
}

void AgeStatistics::show(const telemetry::Snapshot& state, Instant now) {
  advance(now);
  for (std::size_t g = 0; g < telemetry::kGroups; ++g) {
    // A car that restarted has told nothing yet: what was shown stays, and ages.
    if (state.sampled_at[g] != telemetry::kNeverSampled) sampled_[g] = state.sampled_at[g];
  }
}

}  // namespace pitwall::link
