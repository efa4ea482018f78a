// SPDX-License-Identifier: Apache-2.0
#include "hil/radio/age_meter.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::radio {

void AgeMeter::reset() {
  for (Ages& ages : ages_) {
    ages.bins.assign(kBins, 0);
    ages.looks = 0;
    ages.worst = {};
  }
}

void AgeMeter::look(telemetry::Group group, Duration age) {
  Ages& ages = ages_[telemetry::index_of(group)];
  const std::int64_t bin = std::clamp<std::int64_t>(age / milliseconds(1), 0, kBins - 1);
  ++ages.bins[static_cast<std::size_t>(bin)];
  ++ages.looks;
  ages.worst = std::max(ages.worst, age);
}

Duration AgeMeter::quantile(telemetry::Group group, double q) const {
  const Ages& ages = of(group);
  const auto wanted = static_cast<std::uint64_t>(std::ceil(q * static_cast<double>(ages.looks)));
  std::uint64_t seen = 0;
  for (std::size_t bin = 0; bin < kBins && wanted > 0; ++bin) {
    seen += ages.bins[bin];
    if (seen >= wanted) return milliseconds(static_cast<std::int64_t>(bin) + 1);
  }
  return {};
}

}  // namespace pitwall::radio
