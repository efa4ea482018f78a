// SPDX-License-Identifier: Apache-2.0
#include "basestation/link/age_statistics.hpp"

#include <algorithm>

namespace pitwall::link {

void AgeHistogram::add(Duration from, Duration length) {
  if (length.ns <= 0) return;
  from = std::max(from, Duration{});
  const Duration to = from + length;
  largest_ = std::max(largest_, to);
  total_ns_ += length.ns;
  auto bucket =
      static_cast<std::size_t>(std::min(from / kBucket, static_cast<std::int64_t>(kBuckets - 1)));
  for (Duration at = from; at < to; ++bucket) {
    const Duration end =
        bucket + 1 >= kBuckets ? to : std::min(to, kBucket * static_cast<std::int64_t>(bucket + 1));
    time_ns_[bucket] += (end - at).ns;
    at = end;
  }
}

Duration AgeHistogram::quantile(double fraction) const {
  const double wanted_ns = fraction * static_cast<double>(total_ns_);
  std::int64_t below_ns = 0;
  for (std::size_t i = 0; i < kBuckets; ++i) {
    below_ns += time_ns_[i];
    if (time_ns_[i] > 0 && static_cast<double>(below_ns) >= wanted_ns) {
      return std::min(largest_, kBucket * static_cast<std::int64_t>(i + 1));
    }
  }
  return largest_;
}

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
