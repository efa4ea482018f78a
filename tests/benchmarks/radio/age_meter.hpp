// Age of the telemetry at the base in true time, sampled each millisecond: of each group, and of
// the whole vehicle state.
//   in     each millisecond the age of each group that the base has, and the age of the oldest
//          group of the vehicle state (its hundred signals together) once the base has all of them
//   out    quantiles of the whole run or since the last reset
//   units  true time; bins of 1 ms up to kBins, the last one holds all larger ages
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/telemetry/registry/rows.hpp"
#include "protocol/vocabulary/quantile.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::radio {

class AgeMeter {
 public:
  static constexpr std::size_t kBins = 10'000;

  AgeMeter() { reset(); }
  void reset();
  void look(telemetry::Group group, Duration age) { add(ages_[telemetry::index_of(group)], age); }
  void look_at_state(Duration oldest) { add(state_, oldest); }

  // Least age that at least this share of the samples does not exceed; zero without samples.
  Duration quantile(telemetry::Group group, double q) const { return quantile(of(group), q); }
  Duration state_quantile(double q) const { return quantile(state_, q); }
  Duration worst(telemetry::Group group) const { return of(group).worst; }
  std::uint64_t looks(telemetry::Group group) const { return of(group).bins_ms.count(); }

 private:
  struct Ages {
    Histogram bins_ms{kBins};
    Duration worst{};
  };
  static void add(Ages& ages, Duration age);
  static Duration quantile(const Ages& ages, double q);
  const Ages& of(telemetry::Group group) const { return ages_[telemetry::index_of(group)]; }

  std::array<Ages, telemetry::kGroups> ages_;
  Ages state_;
};

}  // namespace pitwall::radio
