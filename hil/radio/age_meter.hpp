// How old what the base shows is, by group, as an onlooker sees it each millisecond; and whether
// the base ever says that a value is younger than it is.
//   in     each millisecond the time of the sample that stands there for each group, and the age
//          that the base tells
//   out    quantiles, whole run or since the last reset
//   units  true time; bins of 1 ms up to kBins, the last holds all above
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "protocol/telemetry/registry/group_row.hpp"
#include "protocol/telemetry/registry/snapshot.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::radio {

class AgeMeter {
 public:
  static constexpr std::size_t kBins = 10'000;

  AgeMeter() { reset(); }
  void reset();
  void look(telemetry::Group group, Duration age);

  // Least age that at least this share of the looks did not exceed; zero without looks.
  Duration quantile(telemetry::Group group, double q) const;
  Duration worst(telemetry::Group group) const { return of(group).worst; }
  std::uint64_t looks(telemetry::Group group) const { return of(group).looks; }

 private:
  struct Ages {
    std::vector<std::uint32_t> bins;
    std::uint64_t looks = 0;
    Duration worst{};
  };
  const Ages& of(telemetry::Group group) const { return ages_[telemetry::index_of(group)]; }

  std::array<Ages, telemetry::kGroups> ages_;
};

}  // namespace pitwall::radio
