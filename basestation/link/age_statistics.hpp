// Age statistics over a run, weighted by time: for each group, and for each class over all its
// groups.
//   in     the state after each packet that changed it
//   out    quantiles by class and by group
//   invariants
//          counting begins with a group's first sample; the age of a group that the car no longer
//          samples keeps growing
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "basestation/link/age_histogram.hpp"
#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::link {

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
