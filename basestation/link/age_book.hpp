// Age statistics over a run, as sampled each millisecond: each group on its own, and a class as a
// look at any of its groups.
//   in     the state after each packet that changed it
//   out    quantiles by class and by group
//   invariants
//          counting begins with a group's first sample; a group that the car stops sampling grows
//          old like any other
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "basestation/link/age_histogram.hpp"
#include "protocol/telemetry/registry/snapshot.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::link {

class AgeBook {
 public:
  // Counts up to now with what was shown until now; then this is shown.
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
