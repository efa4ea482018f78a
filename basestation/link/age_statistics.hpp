// Age statistics over a run, weighted by time: for each group, and for each class over all its
// groups.
//   in     the state after each packet that changed it
//   out    quantiles by class and by group
//   invariants
//          counting begins with a group's first sample and, for Station, ends with the last packet;
//          the age of a group that the car no longer samples keeps growing
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::link {

// Histogram of the age of the newest value, weighted by time. Between two packets the age grows
// evenly, so that each interval is spread over the buckets that it crosses; ages beyond kBuckets
// milliseconds share the last bucket.
class AgeHistogram {
 public:
  static constexpr std::size_t kBuckets = 10'000;
  static constexpr Duration kBucket = milliseconds(1);

  void add(Duration from, Duration length);
  bool empty() const { return total_ns_ == 0; }

  // The age that was not exceeded for this fraction of the time; zero if empty.
  Duration quantile(double fraction) const;
  Duration largest() const { return largest_; }

 private:
  std::array<std::int64_t, kBuckets> time_ns_{};
  std::int64_t total_ns_ = 0;
  Duration largest_{};
};

class AgeStatistics {
 public:
  // advance() counts up to now with the samples shown so far; show() then takes the new ones.
  void advance(Instant now);
  void show(const telemetry::Snapshot& state, Instant now);

  const AgeHistogram& of(telemetry::Class priority) const {
    return classes_[static_cast<std::size_t>(priority)];
  }
  const AgeHistogram& of(telemetry::Group group) const {
    return groups_[telemetry::index_of(group)];
  }

 private:
  std::array<Instant, telemetry::kGroups> sampled_ = telemetry::Snapshot{}.sampled_at;
  Instant counted_to_{};
  std::array<AgeHistogram, telemetry::kClasses> classes_{};
  std::array<AgeHistogram, telemetry::kGroups> groups_{};
};

}  // namespace pitwall::link
